// One hash of all contacts, in order, for every instruction set, thread count, compiler and level
// of optimisation. A change of these numbers is a change of the documented order or of the worlds.

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "harpoon/scene.hpp"
#include "scene/brute_force.hpp"

namespace harpoon::testing {
namespace {

/// Worlds from integer arithmetic alone, so that no library function has a part in them.
template <class Real>
std::vector<SphereOf<Real>> world(std::size_t bodies, bool mixed) {
  std::vector<SphereOf<Real>> spheres;
  std::uint64_t state = 12345;
  const auto next = [&](std::uint64_t below) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<Real>((state >> 33) % below);
  };
  for (std::size_t i = 0; i < bodies; ++i) {
    const Real x = next(1 << 20) / 65536;
    const Real y = next(1 << 20) / 65536;
    const Real z = next(1 << 20) / 65536;
    const Real r = mixed ? (next(31) + 1) * (next(31) + 1) / 4096 : Real(0.25);
    spheres.push_back({x, y, z, r});
  }
  return spheres;
}

template <class Real>
std::uint64_t hash_of_world(std::size_t bodies, bool mixed, unsigned threads,
                            const std::string& instruction_set) {
  const auto spheres = world<Real>(bodies, mixed);
  std::vector<BodyContactOf<Real>> out(200000);
  const auto report =
      detect(BodiesOf<Real>{std::span<const SphereOf<Real>>(spheres)}, std::span(out),
             ContactOrder::space, {.threads = threads, .instruction_set = instruction_set});
  EXPECT_TRUE(report.ok());
  if (!report.ok()) return 0;
  EXPECT_GT(report->contacts, 1000U);
  return hash_of(std::span<const BodyContactOf<Real>>(out).first(report->contacts));
}

TEST(SceneGolden, OneHashForAllMeans) {
  const std::array<std::uint64_t, 4> golden = {6620080586253521152U, 5014979087415626222U,
                                               7240088699379764398U, 5796920241829328805U};
  for (const unsigned threads : {1U, 2U, 3U, 8U}) {
    for (const std::string& name : cpu_instruction_sets()) {
      EXPECT_EQ(hash_of_world<float>(40000, false, threads, name), golden[0]) << name << threads;
      EXPECT_EQ(hash_of_world<float>(40000, true, threads, name), golden[1]) << name << threads;
      EXPECT_EQ(hash_of_world<double>(40000, false, threads, name), golden[2]) << name << threads;
      EXPECT_EQ(hash_of_world<double>(40000, true, threads, name), golden[3]) << name << threads;
    }
  }
}

/// The spheres' bounds, every ninth stretched, and a plane.
template <class Real>
std::uint64_t hash_of_boxes(bool mixed, unsigned threads, const std::string& instruction_set) {
  const auto infinity = std::numeric_limits<Real>::infinity();
  std::vector<std::array<Real, 6>> boxes = {{-infinity, infinity, -infinity, infinity, 0, 1}};
  for (const auto& s : world<Real>(20000, mixed)) {
    const Real longer = boxes.size() % 9 == 0 ? 4 : 1;
    boxes.push_back({s.x - s.r, s.x + longer * s.r, s.y - s.r, s.y + s.r, s.z - s.r, s.z + s.r});
  }
  auto workspace = Workspace::make({.threads = threads, .instruction_set = instruction_set});
  EXPECT_TRUE(workspace.ok());
  if (!workspace) return 0;
  std::vector<IndexPair> out(200000);
  const BoundsOf<Real> bounds(boxes[0].data(), boxes.size());
  const auto report = overlap_pairs(*workspace, bounds, std::span(out));
  EXPECT_TRUE(report.ok());
  if (!report) return 0;
  EXPECT_GT(report->contacts, 1000U);
  return hash_of(std::span<const IndexPair>(out).first(report->contacts));
}

TEST(SceneGolden, OneHashOfPairsForAllMeans) {
  const std::array<std::uint64_t, 4> golden = {6609216579768940108U, 15106525808177617148U,
                                               6609216579768940108U, 15106525808177617148U};
  for (const unsigned threads : {1U, 2U, 3U, 8U}) {
    for (const std::string& name : cpu_instruction_sets()) {
      EXPECT_EQ(hash_of_boxes<float>(false, threads, name), golden[0]) << name << threads;
      EXPECT_EQ(hash_of_boxes<float>(true, threads, name), golden[1]) << name << threads;
      EXPECT_EQ(hash_of_boxes<double>(false, threads, name), golden[2]) << name << threads;
      EXPECT_EQ(hash_of_boxes<double>(true, threads, name), golden[3]) << name << threads;
    }
  }
}

}  // namespace
}  // namespace harpoon::testing
