#pragma once

// A simulated AFU behind the device interface, and batches to give it: shared by the tests of the
// AFU. Results are judged by harpoon::collide, pair by pair.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "device/afu/device.hpp"
#include "sim/simulated_link.hpp"

namespace harpoon::afu_test {

/// The value of a result that must be good.
template <class T>
T take(Result<T> result) {
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  return std::move(result).value();
}

struct Rig {
  std::unique_ptr<afu::AfuDevice> device;
  sim::SimulatedLink* link = nullptr;  ///< owned by the device
};

inline Rig make_rig(const sim::SimulationOptions& simulation, const afu::AfuOptions& options = {}) {
  auto link = sim::SimulatedLink::create(simulation);
  EXPECT_TRUE(link.ok());
  Rig rig;
  rig.link = link->get();
  auto device = afu::make_afu_device(std::move(*link), options);
  EXPECT_TRUE(device.ok()) << (device.ok() ? "" : device.error().message);
  if (device.ok()) rig.device = std::move(*device);
  return rig;
}

inline sim::LinkProfile profile(std::string_view name) {
  return *sim::find_profile(name);
}

/// A pair of every kind: far apart, overlapping, just touching, coincident, huge, tiny, not finite.
inline SpherePair any_pair(std::mt19937_64& random) {
  std::uniform_real_distribution<float> unit(-1, 1);
  const auto near = [&] { return unit(random); };
  switch (random() % 8) {
    case 0: {  // a lattice: many exact touches
      const auto step = [&] { return static_cast<float>(random() % 5); };
      return {{step(), step(), step(), 0.5f}, {step(), step(), step(), 0.5f}};
    }
    case 1: {  // coincident centres
      const Sphere s{near(), near(), near(), std::abs(near())};
      return {s, {s.x, s.y, s.z, std::abs(near())}};
    }
    case 2: {  // any exponent
      const auto wild = [&] { return std::ldexp(near(), static_cast<int>(random() % 250) - 125); };
      return {{wild(), wild(), wild(), std::abs(wild())},
              {wild(), wild(), wild(), std::abs(wild())}};
    }
    case 3: {  // any bits
      const auto bits = [&] { return std::bit_cast<float>(static_cast<std::uint32_t>(random())); };
      return {{bits(), bits(), bits(), bits()}, {bits(), bits(), bits(), bits()}};
    }
    case 4:  // apart
      return {{near(), near(), near(), 0.5f}, {near() + 8, near(), near(), 0.5f}};
    default:  // mostly overlapping
      return {{near(), near(), near(), 0.8f}, {near(), near(), near(), 0.9f}};
  }
}

inline std::vector<SpherePair> any_pairs(std::uint64_t seed, std::size_t count) {
  std::mt19937_64 random(seed);
  std::vector<SpherePair> pairs(count);
  for (SpherePair& pair : pairs) pair = any_pair(random);
  return pairs;
}

/// Pairs of which the given share overlaps; the rest is far apart.
inline std::vector<SpherePair> pairs_with_hits(std::uint64_t seed, std::size_t count,
                                               double share) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::uniform_real_distribution<double> chance(0, 1);
  std::vector<SpherePair> pairs(count);
  for (SpherePair& pair : pairs) {
    pair.s1 = {unit(random), unit(random), unit(random), 0.6f};
    pair.s2 = {pair.s1.x + 0.5f * unit(random), pair.s1.y, pair.s1.z + 0.5f * unit(random), 0.6f};
    if (chance(random) >= share) pair.s2.y += 4;
  }
  return pairs;
}

struct IndexedScene {
  std::vector<Sphere> spheres;
  std::vector<IndexPair> pairs;
};

/// Spheres in pairs that overlap, far from all others; `share` of the index pairs names such two.
inline IndexedScene indexed_scene(std::uint64_t seed, std::size_t spheres, std::size_t pairs,
                                  double share) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> chance(0, 1);
  IndexedScene scene;
  for (std::size_t i = 0; i < spheres; ++i) {
    const auto cell = static_cast<float>(i / 2);
    scene.spheres.push_back({4 * cell + 0.25f * static_cast<float>(i % 2), cell, 0, 0.5f});
  }
  for (std::size_t i = 0; i < pairs; ++i) {
    const auto any = [&] { return static_cast<std::uint32_t>(random() % spheres); };
    const std::uint32_t first = any();
    const auto other = static_cast<std::uint32_t>((first + 2 + random() % (spheres - 3)) % spheres);
    scene.pairs.push_back({first, chance(random) < share ? (first ^ 1u) : other});
  }
  return scene;
}

/// Equal bits; a NaN is a NaN.
inline bool same(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}
template <class C>
bool same_geometry(const C& a, const Contact& b) {
  bool equal = same(a.depth, b.depth);
  for (int i = 0; i < 3; ++i)
    equal = equal && same(a.pos[i], b.pos[i]) && same(a.normal[i], b.normal[i]);
  return equal;
}

/// The first pair whose contact is not that of harpoon::collide; -1 when all are.
inline std::ptrdiff_t first_wrong(const std::vector<SpherePair>& pairs,
                                  const std::vector<Contact>& contacts) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Contact expected = collide(pairs[i]);
    if (contacts[i].flow_word != expected.flow_word || !same_geometry(contacts[i], expected))
      return static_cast<std::ptrdiff_t>(i);
  }
  return -1;
}

/// The contacts of an indexed scene, in pair order.
inline std::vector<BodyContact> expected_contacts(const std::vector<Sphere>& spheres,
                                                  const std::vector<IndexPair>& pairs) {
  std::vector<BodyContact> out;
  for (const IndexPair& pair : pairs) {
    const Contact c = collide(SpherePair{spheres[pair.g1], spheres[pair.g2]});
    if (!c.hit()) continue;
    out.push_back({{c.pos[0], c.pos[1], c.pos[2]},
                   {c.normal[0], c.normal[1], c.normal[2]},
                   c.depth,
                   pair.g1,
                   pair.g2});
  }
  return out;
}

inline bool same_contacts(const std::vector<BodyContact>& a, const BodyContact* b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    bool equal = a[i].g1 == b[i].g1 && a[i].g2 == b[i].g2 && same(a[i].depth, b[i].depth);
    for (int k = 0; k < 3; ++k) {
      equal = equal && same(a[i].pos[k], b[i].pos[k]) && same(a[i].normal[k], b[i].normal[k]);
    }
    if (!equal) return false;
  }
  return true;
}

}  // namespace harpoon::afu_test
