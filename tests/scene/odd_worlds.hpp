#pragma once

// Worlds that spoil a broad phase: a gas or a packing with a few bodies that are far away, huge or
// tiny, and whole worlds without any scale of their own. Lengths are in radii of the usual body.

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "scene/worlds.hpp"

namespace harpoon::testing {

/// Bodies added to a gas or a packing.
enum class Strays : std::uint8_t {
  none,
  far,      ///< in all directions, each ten times as far as any before it, or a bit less
  one_way,  ///< all at one distance along one axis
  fallen,   ///< on a line down one axis
  line,     ///< across all decades, through the world
  plane,
  shell,
  sizes,   ///< of 1e-6 to 1e6 radii, their surfaces in the world or near it
  moons,   ///< large, and far away as well
  beside,  ///< giants all around that just do not reach the world
};
inline constexpr std::array kStrays = {
    Strays::none,  Strays::far,   Strays::one_way, Strays::fallen, Strays::line,
    Strays::plane, Strays::shell, Strays::sizes,   Strays::moons,  Strays::beside};

/// Worlds that are odd as a whole.
enum class OddWorld : std::uint8_t {
  decades,        ///< twelve decades of radii
  giants,         ///< a thousand among grains
  two_clusters,   ///< 1e13 apart
  many_clusters,  ///< of a hundred bodies each, anywhere in 1e9
  log_positions,  ///< as many in each decade of distance, twelve of them
  line,           ///< and each of these with one body far away
  plane,
  shell,
  clumps,  ///< bodies that coincide by the dozen, far apart
};
inline constexpr std::array kOddWorlds = {
    OddWorld::decades,       OddWorld::giants,        OddWorld::two_clusters,
    OddWorld::many_clusters, OddWorld::log_positions, OddWorld::line,
    OddWorld::plane,         OddWorld::shell,         OddWorld::clumps};

template <class Real>
class OddWorldMaker {
 public:
  using Spheres = std::vector<SphereOf<Real>>;
  explicit OddWorldMaker(std::uint64_t seed) : dice_(seed) {}

  /// Equal spheres of radius 1/2: a volume fraction of 0.05, or a jittered lattice of 0.55.
  Spheres usual(int bodies, bool packed) {
    Spheres out;
    side_ = std::cbrt(bodies * std::numbers::pi / 6 / (packed ? 0.55 : 0.05));
    const int width = static_cast<int>(std::ceil(std::cbrt(bodies)));
    const double step = side_ / width;
    for (int i = 0; i < bodies; ++i) {
      const auto at = [&](int node) {
        return packed ? (node + dice_.uniform(-0.2, 0.2)) * step : dice_.uniform(0, side_);
      };
      out.push_back(sphere<Real>(at(i % width), at(i / width % width), at(i / width / width), 0.5));
    }
    return out;
  }

  /// `count` strays among or around what `usual` made. `distance`, where a kind has one, is 1e3 to
  /// 1e15 radii.
  void add(Spheres& world, Strays kind, int count, double distance) {
    const Spheres usual = world;
    for (int k = 0; k < count; ++k) {
      // Anywhere among the others, so that no order of ids gives them away.
      world.push_back(stray(usual, kind, k, distance));
      std::swap(
          world.back(),
          world[static_cast<std::size_t>(dice_.integer(0, static_cast<int>(world.size()) - 1))]);
    }
  }

  Spheres make(OddWorld kind, int bodies) {
    Spheres out;
    side_ = std::cbrt(bodies * std::numbers::pi / 6 / 0.05);
    const Spheres seeds = scattered(std::max(1, bodies / 100), 1e9);
    for (int i = 0; i < bodies; ++i) out.push_back(body(kind, seeds, i));
    const bool flat = kind == OddWorld::line || kind == OddWorld::plane || kind == OddWorld::shell;
    if (flat) add(out, Strays::one_way, 1, 1e12);
    return out;
  }

 private:
  struct Point {
    double x, y, z;
  };

  Spheres scattered(int bodies, double side) {
    Spheres out;
    for (int i = 0; i < bodies; ++i) {
      out.push_back(sphere<Real>(dice_.uniform(0, side), dice_.uniform(0, side),
                                 dice_.uniform(0, side), 0.5));
    }
    return out;
  }

  Point direction() {
    for (;;) {
      const Point p = {dice_.uniform(-1, 1), dice_.uniform(-1, 1), dice_.uniform(-1, 1)};
      const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
      if (length > 0.1 && length < 1) return {p.x / length, p.y / length, p.z / length};
    }
  }

  double decades(double low, double high) { return std::pow(10.0, dice_.uniform(low, high)); }

  SphereOf<Real> around(Point direction, double distance, double r) {
    return sphere<Real>(side_ / 2 + direction.x * distance, side_ / 2 + direction.y * distance,
                        side_ / 2 + direction.z * distance, r);
  }

  SphereOf<Real> stray(const Spheres& usual, Strays kind, int k, double distance) {
    const double span = std::log10(distance);
    switch (kind) {
      case Strays::none:
        break;
      case Strays::far:
        return around(direction(), decades(3, span), 0.5);
      case Strays::one_way:
        return sphere<Real>(dice_.uniform(0, side_), dice_.uniform(0, side_),
                            -distance - dice_.uniform(0, 100 * side_), 0.5);
      case Strays::fallen:
        return sphere<Real>(3, 3, -decades(2, span), 0.5);
      case Strays::line: {
        const double t = dice_.uniform(-distance, distance);
        return sphere<Real>(t, t / 3, side_ / 2, 0.5);
      }
      case Strays::plane:
        return sphere<Real>(dice_.uniform(-distance, distance), dice_.uniform(-distance, distance),
                            side_ / 3, 0.5);
      case Strays::shell:
        return around(direction(), distance, 0.5);
      case Strays::sizes: {
        const double r = 0.5 * decades(-6, 6);
        // A point of its surface is that of a usual body, or a bit away from it.
        const auto& at =
            usual[static_cast<std::size_t>(dice_.integer(0, static_cast<int>(usual.size()) - 1))];
        const Point d = direction();
        const double from = r + dice_.uniform(0, 2);
        return sphere<Real>(static_cast<double>(at.x) + d.x * from,
                            static_cast<double>(at.y) + d.y * from,
                            static_cast<double>(at.z) + d.z * from, r);
      }
      case Strays::moons: {
        const double r = 0.5 * decades(1, 6);
        return around(direction(), 2 * side_ + r + decades(2, span), r);
      }
      case Strays::beside: {
        const double r = side_ * dice_.uniform(0.5, 1e4);
        return around(direction(), r + side_, r);
      }
    }
    return around(direction(), distance * (k + 1), 0.5);
  }

  SphereOf<Real> body(OddWorld kind, const Spheres& seeds, int i) {
    const auto in = [&](double low, double high) { return dice_.uniform(low, high); };
    const auto some = [&](double side) { return dice_.uniform(0, side); };
    switch (kind) {
      case OddWorld::decades:
        return sphere<Real>(some(1e6), some(1e6), some(1e6), decades(-8, 4));
      case OddWorld::giants: {
        const double side = 100 * side_;
        const double r = i % 100 == 0 ? in(10, 20) * side_ : 0.5;
        return sphere<Real>(some(side), some(side), some(side), r);
      }
      case OddWorld::two_clusters: {
        // In float the far one has to be wide enough to be resolved.
        const double far = sizeof(Real) == 4 ? 1e13 : 1e13;
        const double wide = sizeof(Real) == 4 ? 1e8 : 1;
        const double at = i % 2 == 0 ? 0 : far;
        return sphere<Real>(at + some(side_) * wide, some(side_), some(side_) * wide, 0.5);
      }
      case OddWorld::many_clusters: {
        const auto& s = seeds[static_cast<std::size_t>(i) % seeds.size()];
        return sphere<Real>(static_cast<double>(s.x) + some(12),
                            static_cast<double>(s.y) + some(12),
                            static_cast<double>(s.z) + some(12), 0.5);
      }
      case OddWorld::log_positions:
        return around(direction(), decades(0, 12), 0.5);
      case OddWorld::line:
        return sphere<Real>(some(4 * side_ * side_ * side_), 0, 0, 0.5);
      case OddWorld::plane:
        return sphere<Real>(some(side_ * std::sqrt(side_)), some(side_ * std::sqrt(side_)), 7, 0.5);
      case OddWorld::shell:
        return around(direction(), side_ * std::sqrt(side_), 0.5);
      case OddWorld::clumps: {
        const auto& s = seeds[static_cast<std::size_t>(i / 12) % seeds.size()];
        return {s.x, s.y, s.z, Real(0.5)};
      }
    }
    return {};
  }

  Dice dice_;
  double side_ = 1;
};

/// The bounds of spheres.
template <class Real>
std::vector<Box<Real>> bounds_of(const std::vector<SphereOf<Real>>& spheres) {
  std::vector<Box<Real>> out;
  for (const SphereOf<Real>& s : spheres) {
    out.push_back({s.x - s.r, s.x + s.r, s.y - s.r, s.y + s.r, s.z - s.r, s.z + s.r});
  }
  return out;
}

}  // namespace harpoon::testing
