// detect against the collider on all pairs: set, bits, order and independence of means.

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <thread>

#include "harpoon/scene.hpp"
#include "scene/brute_force.hpp"
#include "scene/worlds.hpp"

namespace harpoon::testing {
namespace {

constexpr std::uint64_t kSeed = 20240611;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kScenesOfWorld = 8;  // unoptimised kernels are slow; the release run has them all
constexpr int kManyBodies = 800;
constexpr std::ptrdiff_t kInstructionSets = 1;
constexpr std::array kThreadCounts = {2U, 8U};
constexpr std::array kLargeWorlds = {World::packed, World::clusters};
#else
constexpr int kScenesOfWorld = 130;  // x 8 worlds x 2 precisions > 2,000
constexpr int kManyBodies = 9000;
constexpr std::ptrdiff_t kInstructionSets = 100;
constexpr std::array kThreadCounts = {1U, 2U, 3U, 8U};
constexpr std::array kLargeWorlds = kWorlds;
#endif

/// Those to run on: the widest of them.
std::vector<std::string> instruction_sets() {
  std::vector<std::string> all = cpu_instruction_sets();
  if (std::ssize(all) > kInstructionSets) all.erase(all.begin(), all.end() - kInstructionSets);
  return all;
}

Workspace workspace(unsigned threads, const std::string& instruction_set = {}) {
  auto made = Workspace::make({.threads = threads, .instruction_set = instruction_set});
  EXPECT_TRUE(made.ok());
  return std::move(made.value());
}

template <class Real>
std::vector<BodyContactOf<Real>> run(Workspace& workspace, const BodiesOf<Real>& bodies,
                                     std::size_t capacity,
                                     ContactOrder order = ContactOrder::space) {
  std::vector<BodyContactOf<Real>> out(capacity);
  const auto report = detect(workspace, bodies, std::span(out), order);
  EXPECT_TRUE(report.ok()) << report.error().message;
  if (!report.ok()) return {};
  out.resize(report->contacts);
  return out;
}

template <class Real>
std::span<const SphereOf<Real>> view(const std::vector<SphereOf<Real>>& spheres) {
  return spheres;
}

template <class Real>
class DetectTest : public ::testing::Test {};
using Reals = ::testing::Types<float, double>;
TYPED_TEST_SUITE(DetectTest, Reals);

int bodies_of_scene(Dice& dice) {
  if (dice.one_in(20)) return dice.integer(0, 3);
  return dice.one_in(10) ? dice.integer(600, 1200) : dice.integer(4, 300);
}

TYPED_TEST(DetectTest, EqualsBruteForceInEveryWorld) {
  using Real = TypeParam;
  std::vector<Workspace> workspaces;
  for (const std::string& name : instruction_sets()) {
    workspaces.push_back(workspace(1, name));
  }
  std::map<World, std::uint64_t> contacts;
  std::size_t turn = 0;
  for (const World world : kWorlds) {
    for (int scene = 0; scene < kScenesOfWorld; ++scene) {
      const std::uint64_t seed =
          kSeed + static_cast<std::uint64_t>(scene) * 8 + static_cast<std::uint64_t>(world);
      Dice dice(seed);
      const auto spheres = WorldMaker<Real>(seed).make(world, bodies_of_scene(dice));
      const auto expected = brute_force(view(spheres));
      contacts[world] += expected.size();
      Workspace& means = workspaces[turn++ % workspaces.size()];
      const auto got = run(means, BodiesOf<Real>(view(spheres)), expected.size());
      ASSERT_TRUE(same_bits(sorted_by_ids(got), expected))
          << "world " << static_cast<int>(world) << " seed " << seed << " bodies " << spheres.size()
          << " expected " << expected.size() << " got " << got.size();
    }
  }
  for (const World world : kWorlds) {
    EXPECT_GT(contacts[world], 8U * kScenesOfWorld)
        << "world " << static_cast<int>(world) << " is vacuous";
  }
}

TYPED_TEST(DetectTest, OneHashForThreadsInstructionSetsAndViews) {
  using Real = TypeParam;
  for (const World world : kWorlds) {
    const int bodies = world == World::point ? kManyBodies / 12 : kManyBodies;
    const auto spheres = WorldMaker<Real>(kSeed + 7).make(world, bodies);
    const BodiesOf<Real> records(view(spheres));
    Workspace first = workspace(1);
    const auto counted = count_contacts(first, records);
    ASSERT_TRUE(counted.ok());
    const auto expected = run(first, records, counted->contacts);
    ASSERT_EQ(expected.size(), counted->contacts);
    EXPECT_FALSE(expected.empty());
    for (const unsigned threads : kThreadCounts) {
      for (const std::string& name : instruction_sets()) {
        Workspace means = workspace(threads, name);
        EXPECT_TRUE(same_bits(run(means, records, counted->contacts + 5), expected))
            << "world " << static_cast<int>(world) << " threads " << threads << " " << name;
      }
    }
    std::vector<Real> x, y, z, r;
    for (const auto& s : spheres) {
      x.push_back(s.x);
      y.push_back(s.y);
      z.push_back(s.z);
      r.push_back(s.r);
    }
    const BodiesOf<Real> arrays(x.data(), y.data(), z.data(), r.data(), x.size());
    EXPECT_TRUE(same_bits(run(first, arrays, counted->contacts), expected));
    struct Particle {
      int tag;
      SphereOf<Real> sphere;
      double mass;
    };
    std::vector<Particle> particles;
    for (const auto& s : spheres) particles.push_back({1, s, 2});
    const BodiesOf<Real> strided(&particles[0].sphere.x, sizeof(Particle), particles.size());
    EXPECT_TRUE(same_bits(run(first, strided, counted->contacts), expected));
  }
}

TYPED_TEST(DetectTest, SortsByIdsOnRequest) {
  using Real = TypeParam;
  const auto spheres = WorldMaker<Real>(kSeed).make(World::packed, kManyBodies);
  for (const unsigned threads : {1U, 3U}) {
    Workspace means = workspace(threads);
    const auto space = run(means, BodiesOf<Real>(view(spheres)), 100000);
    const auto ids = run(means, BodiesOf<Real>(view(spheres)), 100000, ContactOrder::ids);
    EXPECT_GT(space.size(), static_cast<std::size_t>(kManyBodies) / 4);
    EXPECT_TRUE(same_bits(sorted_by_ids(space), ids));
  }
}

TYPED_TEST(DetectTest, PairsAndCountAgreeWithContacts) {
  using Real = TypeParam;
  for (const World world : kWorlds) {
    const auto spheres = WorldMaker<Real>(kSeed + 1).make(world, 500);
    const BodiesOf<Real> bodies(view(spheres));
    for (const ContactOrder order : {ContactOrder::space, ContactOrder::ids}) {
      Workspace means = workspace(1);
      const auto contacts = run(means, bodies, 200000, order);
      std::vector<IndexPair> pairs(contacts.size());
      const auto report = detect_pairs(means, bodies, std::span(pairs), order);
      ASSERT_TRUE(report.ok());
      ASSERT_EQ(report->contacts, contacts.size());
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        ASSERT_EQ(pairs[k].g1, contacts[k].g1);
        ASSERT_EQ(pairs[k].g2, contacts[k].g2);
      }
      EXPECT_EQ(count_contacts(means, bodies)->contacts, contacts.size());
    }
  }
}

TYPED_TEST(DetectTest, AppliesFilters) {
  using Real = TypeParam;
  Dice dice(kSeed);
  for (int scene = 0; scene < 60; ++scene) {
    const World world = kWorlds[static_cast<std::size_t>(scene) % kWorlds.size()];
    const auto spheres =
        WorldMaker<Real>(kSeed + static_cast<std::uint64_t>(scene)).make(world, 250);
    std::vector<std::uint32_t> category, collide, owner;
    std::vector<Rest> rest;
    for (std::size_t k = 0; k < spheres.size(); ++k) {
      category.push_back(static_cast<std::uint32_t>(dice.integer(0, 7)));
      collide.push_back(static_cast<std::uint32_t>(dice.integer(0, 7)));
      owner.push_back(static_cast<std::uint32_t>(dice.integer(0, 9)));
      rest.push_back(static_cast<Rest>(dice.integer(0, 2)));
    }
    BodiesOf<Real> bodies(view(spheres));
    if (scene % 2 == 0) {
      bodies.filters.category = category;
      bodies.filters.collide = collide;
    }
    if (scene % 3 == 0) bodies.filters.owner = owner;
    if (scene % 4 < 2) bodies.filters.rest = rest;
    const auto expected = brute_force(view(spheres), bodies.filters);
    Workspace means = workspace(1);
    EXPECT_TRUE(same_bits(sorted_by_ids(run(means, bodies, expected.size())), expected));
    EXPECT_EQ(count_contacts(means, bodies)->contacts, expected.size());
  }
}

TYPED_TEST(DetectTest, LeavesOutAndReportsInvalidBodies) {
  using Real = TypeParam;
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  const Real inf = std::numeric_limits<Real>::infinity();
  const Real beyond = std::nextafter(kSceneLimit<Real>, inf);
  const std::array bad = {nan, inf, -inf, beyond, -beyond};
  for (const World world : kWorlds) {
    auto spheres = WorldMaker<Real>(kSeed + 2).make(world, 400);
    std::vector<std::uint32_t> excluded;
    for (std::size_t k = 0; k < spheres.size(); k += 13) {
      Real* const fields[4] = {&spheres[k].x, &spheres[k].y, &spheres[k].z, &spheres[k].r};
      *fields[k % 4] = bad[k % bad.size()];
      excluded.push_back(static_cast<std::uint32_t>(k));
    }
    spheres.back().r = -1;
    excluded.push_back(static_cast<std::uint32_t>(spheres.size() - 1));
    const auto expected = brute_force(view(spheres));
    Workspace means = workspace(1);
    std::vector<BodyContactOf<Real>> out(expected.size());
    const auto report = detect(means, BodiesOf<Real>(view(spheres)), std::span(out));
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report->excluded, excluded);
    EXPECT_TRUE(same_bits(sorted_by_ids(out), expected)) << static_cast<int>(world);
  }
}

TYPED_TEST(DetectTest, AcceptsTheLimitItself) {
  using Real = TypeParam;
  const Real limit = kSceneLimit<Real>;
  const std::vector<SphereOf<Real>> spheres = {
      {limit, limit, limit, limit}, {-limit, -limit, -limit, limit}, {limit, limit, 0, limit}};
  Workspace means = workspace(1);
  EXPECT_TRUE(same_bits(sorted_by_ids(run(means, BodiesOf<Real>(view(spheres)), 3)),
                        brute_force(view(spheres))));
}

TYPED_TEST(DetectTest, TooSmallAnOutputIsUntouchedAndTheNeedExact) {
  using Real = TypeParam;
  for (const World world : kLargeWorlds) {
    const auto spheres = WorldMaker<Real>(kSeed + 3).make(
        world, world == World::point ? kManyBodies / 12 : kManyBodies);
    const BodiesOf<Real> bodies(view(spheres));
    for (const unsigned threads : {1U, 2U}) {
      Workspace means = workspace(threads);
      const std::uint64_t needed = count_contacts(means, bodies)->contacts;
      if (needed == 0) continue;
      for (const std::uint64_t capacity : {std::uint64_t{0}, needed / 2, needed - 1}) {
        BodyContactOf<Real> mark;
        std::memset(&mark, 0x5A, sizeof mark);
        std::vector<BodyContactOf<Real>> out(capacity, mark);
        const auto before = hash_of(std::span<const BodyContactOf<Real>>(out));
        const auto report = detect(means, bodies, std::span(out));
        ASSERT_FALSE(report.ok());
        EXPECT_EQ(report.error().code, Errc::capacity);
        EXPECT_EQ(report.error().needed, needed);
        EXPECT_EQ(hash_of(std::span<const BodyContactOf<Real>>(out)), before);
      }
      EXPECT_EQ(run(means, bodies, needed).size(), needed);
    }
  }
}

TYPED_TEST(DetectTest, EverythingInOnePointNeedsLittleMemory) {
  using Real = TypeParam;
  const std::vector<SphereOf<Real>> spheres(kManyBodies, SphereOf<Real>{1, 2, 3, Real(0.5)});
  Workspace means = workspace(1);
  const auto report = count_contacts(means, BodiesOf<Real>(view(spheres)));
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->contacts, std::uint64_t{kManyBodies} * (kManyBodies - 1) / 2);
  EXPECT_LT(means.bytes(), std::size_t{2} << 20);
}

TYPED_TEST(DetectTest, MemoryDoesNotGrowWithTheVolume) {
  using Real = TypeParam;
  Dice dice(kSeed);
  std::vector<SphereOf<Real>> spheres;
  for (int k = 0; k < 4000; ++k) {
    const double far = k % 2 == 0 ? 1e6 : -1e6;
    spheres.push_back(sphere<Real>(far + dice.uniform(0, 20), far + dice.uniform(0, 20),
                                   far + dice.uniform(0, 20), 0.5));
  }
  Workspace means = workspace(1);
  const auto report = count_contacts(means, BodiesOf<Real>(view(spheres)));
  ASSERT_TRUE(report.ok());
  EXPECT_GT(report->contacts, 100U);
  EXPECT_LT(means.bytes(), 4000U * 400U);
  EXPECT_LT(report->tests, 4000U * 200U) << "clusters must not share cells by the thousand";
}

TYPED_TEST(DetectTest, EmptyAndSingle) {
  using Real = TypeParam;
  Workspace means = workspace(1);
  EXPECT_EQ(run(means, BodiesOf<Real>(), 4).size(), 0U);
  const std::vector<SphereOf<Real>> one = {{1, 2, 3, 4}};
  EXPECT_EQ(run(means, BodiesOf<Real>(view(one)), 4).size(), 0U);
}

TYPED_TEST(DetectTest, RejectsBadArguments) {
  using Real = TypeParam;
  Workspace means = workspace(1);
  const std::vector<SphereOf<Real>> spheres(3, SphereOf<Real>{0, 0, 0, 1});
  std::vector<BodyContactOf<Real>> out(9);
  BodiesOf<Real> null_array(view(spheres));
  null_array.z = nullptr;
  BodiesOf<Real> odd_stride(view(spheres));
  odd_stride.stride_bytes = sizeof(SphereOf<Real>) + 1;
  BodiesOf<Real> half_filter(view(spheres));
  const std::vector<std::uint32_t> bits(3, 1);
  half_filter.filters.category = bits;
  BodiesOf<Real> short_filter(view(spheres));
  short_filter.filters.owner = std::span(bits).first(2);
  for (const auto& bodies : {null_array, odd_stride, half_filter, short_filter}) {
    const auto report = detect(means, bodies, std::span(out));
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.error().code, Errc::invalid_argument);
    EXPECT_FALSE(report.error().message.empty());
  }
  BodiesOf<Real> too_many(view(spheres));
  too_many.count = kMaxBodies + 1;
  EXPECT_EQ(detect(means, too_many, std::span(out)).error().code, Errc::batch_too_large);
  EXPECT_EQ(Workspace::make({.threads = 5000}).error().code, Errc::invalid_argument);
  EXPECT_EQ(Workspace::make({.instruction_set = "abacus"}).error().code, Errc::invalid_argument);
}

TYPED_TEST(DetectTest, RunsOnAnInjectedParallelForAndReportsABrokenOne) {
  using Real = TypeParam;
  const auto spheres = WorldMaker<Real>(kSeed).make(World::packed, 9000);
  const BodiesOf<Real> bodies(view(spheres));
  Workspace reference = workspace(1);
  const auto expected = run(reference, bodies, 100000);
  int calls = 0;
  const ParallelFor backwards = [&](std::size_t tasks, const auto& body) {
    ++calls;
    for (std::size_t t = tasks; t-- > 0;) body(t);
  };
  auto injected = Workspace::make({.threads = 4, .parallel_for = backwards});
  ASSERT_TRUE(injected.ok());
  EXPECT_TRUE(same_bits(run(*injected, bodies, 100000), expected));
  EXPECT_GT(calls, 0);
  const ParallelFor lazy = [](std::size_t, const auto& body) { body(0); };
  auto broken = Workspace::make({.threads = 4, .parallel_for = lazy});
  std::vector<BodyContactOf<Real>> out(100000);
  EXPECT_EQ(detect(*broken, bodies, std::span(out)).error().code, Errc::executor_failed);
}

}  // namespace
}  // namespace harpoon::testing
