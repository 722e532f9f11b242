// Every allocation of a call fails once: a typed error, and the next call is right again.

#include <gtest/gtest.h>

#include "harpoon/scene.hpp"
#include "scene/brute_force.hpp"
#include "scene/worlds.hpp"
#include "support/failing_allocations.hpp"

namespace harpoon::testing {
namespace {

std::vector<Sphere> some_world() {
  auto spheres = WorldMaker<float>(5).make(World::mixed, 1500);
  spheres[7].x = std::numeric_limits<float>::quiet_NaN();
  return spheres;
}

/// Calls attempt() with its n-th allocation failing, for every n until none fails. attempt returns
/// the error, if any.
template <class Attempt>
int fail_everywhere(const Attempt& attempt) {
  for (int n = 0;; ++n) {
    test::fail_allocation(n);
    const std::optional<Errc> error = attempt();
    const bool failed = test::allocation_has_failed();
    if (!failed) {
      EXPECT_FALSE(error.has_value());
      return n;
    }
    EXPECT_EQ(error, Errc::out_of_memory) << "allocation " << n;
    if (error != Errc::out_of_memory) return n;
  }
}

template <class T>
std::optional<Errc> code_of(const Result<T>& result) {
  return result ? std::nullopt : std::optional(result.error().code);
}

TEST(OutOfMemory, EveryAllocationOfDetect) {
  const auto spheres = some_world();
  const auto expected = brute_force<float>(spheres);
  std::vector<BodyContact> out(expected.size());
  const Bodies bodies{std::span<const Sphere>(spheres)};
  for (const ContactOrder order : {ContactOrder::space, ContactOrder::ids}) {
    const int allocations = fail_everywhere(
        [&] { return code_of(detect(bodies, std::span(out), order, {.threads = 1})); });
    EXPECT_GT(allocations, 8);
    EXPECT_TRUE(same_bits(sorted_by_ids(out), expected));
  }
}

TEST(OutOfMemory, AWorkspaceSurvives) {
  const auto spheres = some_world();
  const auto expected = brute_force<float>(spheres);
  std::vector<BodyContact> out(expected.size());
  const Bodies bodies{std::span<const Sphere>(spheres)};
  auto workspace = Workspace::make({.threads = 1});
  ASSERT_TRUE(workspace.ok());
  fail_everywhere([&] { return code_of(detect(*workspace, bodies, std::span(out))); });
  ASSERT_TRUE(detect(*workspace, bodies, std::span(out)).ok());
  EXPECT_TRUE(same_bits(sorted_by_ids(out), expected));
}

TEST(OutOfMemory, EveryAllocationOfOverlapPairs) {
  std::array<int, kBoxKinds> seen = {};
  auto boxes = boxes_around(some_world(), 3, 20, seen);
  for (auto& box : boxes) box[5] += 1e6F;  // long along z: the grid has no such axis
  const auto expected = overlapping(boxes);
  std::vector<IndexPair> out(expected.size());
  const Bounds bounds(boxes[0].data(), boxes.size());
  for (const ContactOrder order : {ContactOrder::space, ContactOrder::ids}) {
    auto workspace = Workspace::make({.threads = 1});
    ASSERT_TRUE(workspace.ok());
    const int allocations = fail_everywhere(
        [&] { return code_of(overlap_pairs(*workspace, bounds, std::span(out), order)); });
    EXPECT_GT(allocations, 8);
    const auto sorted = sorted_by_ids(out);
    EXPECT_TRUE(std::equal(
        sorted.begin(), sorted.end(), expected.begin(), expected.end(),
        [](const IndexPair& a, const IndexPair& b) { return a.g1 == b.g1 && a.g2 == b.g2; }));
  }
}

TEST(OutOfMemory, ASharedFrameFailsAndSucceeds) {
  auto spheres = WorldMaker<float>(5).make(World::packed, 6000);
  const ParallelFor in_turn = [](std::size_t tasks, const auto& body) {
    for (std::size_t t = 0; t < tasks; ++t) body(t);
  };
  auto alone = Scene::make({.threads = 1});
  auto shared = Scene::make({.threads = 2, .parallel_for = in_turn});
  ASSERT_TRUE(alone.ok() && shared.ok());
  for (int frame = 0; frame < 3; ++frame) {
    const Bodies bodies{std::span<const Sphere>(spheres)};
    ASSERT_FALSE(alone->set_bodies(bodies));
    const auto expected = alone->detect();
    ASSERT_TRUE(expected.ok());
    EXPECT_GT(expected->contacts.size(), 4096U);  // several chunks
    fail_everywhere([&]() -> std::optional<Errc> {
      if (auto error = shared->set_bodies(bodies)) return error->code;
      return code_of(shared->detect());
    });
    const auto got = shared->detect();
    ASSERT_TRUE(got.ok());
    EXPECT_EQ(hash_of(got->contacts), hash_of(expected->contacts));
    for (Sphere& s : spheres) s.x += s.r / 200;
  }
}

TEST(OutOfMemory, AScenePersists) {
  const auto spheres = some_world();
  const auto expected = brute_force<float>(spheres);
  auto scene = Scene::make({.threads = 1});
  ASSERT_TRUE(scene.ok());
  for (const Sphere& s : spheres) {
    fail_everywhere([&] { return code_of(scene->add(s)); });
  }
  fail_everywhere([&] { return code_of(scene->detect()); });
  const auto frame = scene->detect();
  ASSERT_TRUE(frame.ok());
  EXPECT_TRUE(same_bits({frame->contacts.begin(), frame->contacts.end()}, expected));
  const int allocations = fail_everywhere([&]() -> std::optional<Errc> {
    auto fresh = Scene::make({.threads = 1});
    if (!fresh) return fresh.error().code;
    if (auto error = fresh->set_bodies(Bodies{std::span<const Sphere>(spheres)})) {
      return error->code;
    }
    return code_of(fresh->detect());
  });
  EXPECT_GT(allocations, 10);
}

}  // namespace
}  // namespace harpoon::testing
