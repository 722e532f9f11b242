// Every door of the scene with its work shared between threads, and with several callers at once:
// small enough for the thread sanitizer, large enough that every pass is shared.

#include <gtest/gtest.h>

#include <thread>

#include "harpoon/scene.hpp"
#include "scene/brute_force.hpp"
#include "scene/worlds.hpp"

namespace harpoon::testing {
namespace {

constexpr std::uint64_t kSeed = 4711;
constexpr int kBodies = 20000;
constexpr std::size_t kRoom = 150000;

/// Bytes of all that the doors find in some worlds and orders.
template <class Real>
std::uint64_t hash_of_doors(Workspace& workspace, unsigned threads) {
  std::uint64_t hash = 1;
  for (const World world : {World::packed, World::mixed}) {
    auto spheres = WorldMaker<Real>(kSeed).make(world, kBodies);
    spheres[17].x = std::numeric_limits<Real>::quiet_NaN();
    const BodiesOf<Real> bodies{std::span<const SphereOf<Real>>(spheres)};
    std::array<int, kBoxKinds> seen = {};
    const auto boxes = boxes_around(spheres, kSeed, 1, seen);
    const BoundsOf<Real> bounds(boxes[0].data(), boxes.size());
    for (const ContactOrder order : {ContactOrder::space, ContactOrder::ids}) {
      std::vector<BodyContactOf<Real>> contacts(kRoom);
      const auto found = detect(workspace, bodies, std::span(contacts), order);
      EXPECT_TRUE(found.ok());
      if (!found) return 0;
      EXPECT_GT(found->contacts, 1000U);
      hash = hash_of(std::span<const BodyContactOf<Real>>(contacts).first(found->contacts), hash);
      std::vector<IndexPair> pairs(4 * kRoom);
      const auto overlaps = overlap_pairs(workspace, bounds, std::span(pairs), order);
      EXPECT_TRUE(overlaps.ok());
      if (!overlaps) return 0;
      EXPECT_GT(overlaps->contacts, found->contacts);
      hash = hash_of(std::span<const IndexPair>(pairs).first(overlaps->contacts), hash);
    }
    EXPECT_EQ(count_contacts(workspace, bodies)->contacts,
              detect_pairs(workspace, bodies, {}).error().needed);
    auto scene = SceneOf<Real>::make({.threads = threads});
    EXPECT_TRUE(scene.ok());
    for (int frame = 0; frame < 4; ++frame) {
      EXPECT_FALSE(scene->set_bodies(bodies));
      const auto contacts = scene->detect();
      EXPECT_TRUE(contacts.ok());
      hash = hash_of(contacts->contacts, hash);
      for (auto& s : spheres) s.y += s.r / 100;
    }
  }
  return hash;
}

template <class Real>
std::uint64_t hash_with(unsigned threads) {
  auto workspace = Workspace::make({.threads = threads});
  EXPECT_TRUE(workspace.ok());
  return hash_of_doors<Real>(*workspace, threads);
}

TEST(SceneThreads, OneResultForOneAndThreeThreads) {
  EXPECT_EQ(hash_with<float>(3), hash_with<float>(1));
  EXPECT_EQ(hash_with<double>(3), hash_with<double>(1));
}

/// Contacts of a scene over some frames, on an executor of the caller's.
std::uint64_t hash_of_scene(unsigned threads, const ParallelFor& parallel_for) {
  auto spheres = WorldMaker<float>(kSeed).make(World::packed, kBodies);
  auto scene = Scene::make({.threads = threads, .parallel_for = parallel_for});
  EXPECT_TRUE(scene.ok());
  std::uint64_t hash = 1;
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_FALSE(scene->set_bodies(Bodies{std::span<const Sphere>(spheres)}));
    const auto contacts = scene->detect();
    EXPECT_TRUE(contacts.ok());
    if (!contacts) return 0;
    EXPECT_GT(contacts->contacts.size(), 10000U);  // many chunks of output
    hash = hash_of(contacts->contacts, hash);
    for (auto& s : spheres) s.y += s.r / 100;
  }
  return hash;
}

TEST(SceneThreads, AnInjectedExecutorMayRunTasksInAnyOrder) {
  const std::uint64_t expected = hash_of_scene(1, {});
  int calls = 0;
  const ParallelFor backwards = [&](std::size_t tasks, const auto& body) {
    ++calls;
    for (std::size_t t = tasks; t-- > 0;) body(t);
  };
  const ParallelFor all_at_once = [](std::size_t tasks, const auto& body) {
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < tasks; ++t) threads.emplace_back([&body, t] { body(t); });
    for (std::thread& thread : threads) thread.join();
  };
  EXPECT_EQ(hash_of_scene(3, backwards), expected);
  EXPECT_EQ(hash_of_scene(3, all_at_once), expected);
  EXPECT_GT(calls, 10);
}

TEST(SceneThreads, WorkspacesWorkAtOnce) {
  const std::uint64_t expected = hash_with<float>(1);
  std::array<std::uint64_t, 2> got = {};
  std::thread other([&] { got[0] = hash_with<float>(2); });
  got[1] = hash_with<float>(2);
  other.join();
  EXPECT_EQ(got[0], expected);
  EXPECT_EQ(got[1], expected);
}

}  // namespace
}  // namespace harpoon::testing
