// What must hold between runs of the scene on related worlds, whatever the worlds: permuting bodies
// permutes ids only, an exact translation changes no pair, removing a body removes its pairs only.
// Coordinates are small multiples of 1/16, so that every move and difference is exact.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "harpoon/scene.hpp"

namespace harpoon::testing {
namespace {

using Lattice = std::vector<std::tuple<int, int, int, int>>;  ///< x, y, z, size in sixteenths

/// Up to several hundred bodies, crowded enough for contacts.
rc::Gen<Lattice> worlds() {
  const auto place = rc::gen::inRange(-60, 60);
  const auto body = rc::gen::tuple(place, place, place, rc::gen::inRange(0, 24));
  return rc::gen::scale(7, rc::gen::container<Lattice>(body));
}

std::vector<SphereF64> spheres_of(const Lattice& lattice, std::array<int, 3> by = {0, 0, 0}) {
  std::vector<SphereF64> out;
  for (const auto& [x, y, z, size] : lattice) {
    out.push_back({(x + by[0]) / 16.0, (y + by[1]) / 16.0, (z + by[2]) / 16.0, size / 16.0});
  }
  return out;
}

/// A pair, and for spheres how deep its contact is.
struct Meeting {
  std::uint32_t g1, g2;
  double depth;
  auto operator<=>(const Meeting&) const = default;
};

enum class Shape : std::uint8_t { spheres, boxes };

std::vector<Meeting> meetings(const std::vector<SphereF64>& spheres, Shape shape) {
  auto workspace = Workspace::make({.threads = 1});
  RC_ASSERT(workspace.ok());
  const std::size_t most = spheres.size() * spheres.size() / 2 + 1;
  std::vector<Meeting> out;
  if (shape == Shape::spheres) {
    std::vector<BodyContactF64> contacts(most);
    const BodiesF64 bodies{std::span<const SphereF64>(spheres)};
    const auto report = detect(*workspace, bodies, std::span(contacts));
    RC_ASSERT(report.ok());
    contacts.resize(report->contacts);
    for (const auto& c : contacts) out.push_back({c.g1, c.g2, c.depth});
  } else {
    std::vector<double> boxes;
    for (const SphereF64& s : spheres) {  // sides in the ratio 1 : 2 : 3
      boxes.insert(boxes.end(), {s.x, s.x + s.r, s.y, s.y + 2 * s.r, s.z, s.z + 3 * s.r});
    }
    std::vector<IndexPair> pairs(most);
    const BoundsF64 bounds(boxes.data(), spheres.size());
    const auto report = overlap_pairs(*workspace, bounds, std::span(pairs));
    RC_ASSERT(report.ok());
    pairs.resize(report->contacts);
    for (const auto& p : pairs) out.push_back({p.g1, p.g2, 0});
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// Runs a property on both shapes. Classes show how many worlds had something to lose.
template <class Property>
void holds(const std::string& description, const Property& property) {
  for (const Shape shape : {Shape::spheres, Shape::boxes}) {
    std::size_t most = 0;
    const bool success =
        rc::check(description + (shape == Shape::spheres ? " (spheres)" : " (boxes)"), [&] {
          const Lattice lattice = *worlds();
          const auto before = meetings(spheres_of(lattice), shape);
          most = std::max(most, before.size());
          property(lattice, shape, before);
        });
    EXPECT_TRUE(success);
    EXPECT_GT(most, 50U) << "worlds without contacts prove nothing";
  }
}

TEST(SceneProperties, PermutingBodiesPermutesIdsOnly) {
  holds("permutation", [](const Lattice& lattice, Shape shape, const auto& before) {
    std::vector<std::uint32_t> place(lattice.size());
    std::iota(place.begin(), place.end(), 0U);
    const auto turn = *rc::gen::inRange<std::size_t>(0, lattice.size() + 1);
    std::rotate(place.begin(), place.begin() + static_cast<std::ptrdiff_t>(turn), place.end());
    if (*rc::gen::arbitrary<bool>()) std::reverse(place.begin(), place.end());
    Lattice permuted(lattice.size());
    for (std::size_t i = 0; i < lattice.size(); ++i) permuted[place[i]] = lattice[i];
    std::vector<Meeting> expected;
    for (const Meeting& m : before) {
      const auto [low, high] = std::minmax(place[m.g1], place[m.g2]);
      expected.push_back({low, high, m.depth});
    }
    std::sort(expected.begin(), expected.end());
    RC_ASSERT(meetings(spheres_of(permuted), shape) == expected);
  });
}

TEST(SceneProperties, AnExactTranslationKeepsTheSet) {
  holds("translation", [](const Lattice& lattice, Shape shape, const auto& before) {
    const auto step = rc::gen::inRange(-(1 << 20), 1 << 20);
    const std::array<int, 3> by = {*step, *step, *step};
    RC_ASSERT(meetings(spheres_of(lattice, by), shape) == before);
  });
}

TEST(SceneProperties, RemovingABodyRemovesItsContactsOnly) {
  holds("removal", [](const Lattice& lattice, Shape shape, const auto& before) {
    RC_PRE(!lattice.empty());
    const auto gone =
        *rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(lattice.size()));
    Lattice left = lattice;
    left.erase(left.begin() + gone);
    std::vector<Meeting> expected;
    for (const Meeting& m : before) {
      if (m.g1 == gone || m.g2 == gone) continue;
      expected.push_back({m.g1 - (m.g1 > gone ? 1U : 0U), m.g2 - (m.g2 > gone ? 1U : 0U), m.depth});
    }
    RC_ASSERT(meetings(spheres_of(left), shape) == expected);
  });
}

}  // namespace
}  // namespace harpoon::testing
