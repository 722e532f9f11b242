#pragma once

// Random worlds for the scene's tests: eight distributions chosen to hurt, in both precisions.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "harpoon/records.hpp"

namespace harpoon::testing {

enum class World {
  gas,       ///< uniform, equal radii
  packed,    ///< jittered lattice, most neighbours near touching
  mixed,     ///< radii 1:1000, some zero
  point,     ///< everything within a body's size, many duplicates
  line,      ///< a line, in some scenes a plane
  clusters,  ///< tight clusters 10^6 apart
  lattice,   ///< exact multiples of the reach, moved by a few ulps: on every cell border
  extreme,   ///< huge, tiny and subnormal magnitudes; now and then a giant among grains
};
inline constexpr std::array kWorlds = {World::gas,     World::packed, World::mixed,
                                       World::point,   World::line,   World::clusters,
                                       World::lattice, World::extreme};

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  bool one_in(int n) { return integer(1, n) == 1; }

 private:
  std::mt19937_64 engine_;
};

template <class Real>
Real some_ulps(Real value, int ulps) {
  const Real to =
      ulps < 0 ? -std::numeric_limits<Real>::infinity() : std::numeric_limits<Real>::infinity();
  for (int k = std::abs(ulps); k > 0; --k) value = std::nextafter(value, to);
  return value;
}

template <class Real>
SphereOf<Real> sphere(double x, double y, double z, double r) {
  return {static_cast<Real>(x), static_cast<Real>(y), static_cast<Real>(z), static_cast<Real>(r)};
}

template <class Real>
class WorldMaker {
 public:
  explicit WorldMaker(std::uint64_t seed) : dice_(seed) {}

  std::vector<SphereOf<Real>> make(World world, int bodies) {
    scale_ = std::ldexp(1.0, dice_.integer(-8, 8));
    side_ = std::cbrt(static_cast<double>(std::max(1, bodies)));
    world_scale_ = scale_ * dice_.uniform(0.6, 3);
    lattice_width_ = std::max(2, static_cast<int>(side_));
    lattice_mode_ = dice_.integer(0, 2);
    line_mode_ = dice_.integer(0, 2);
    extreme_mode_ = dice_.integer(0, 3);
    std::vector<SphereOf<Real>> out;
    for (int i = 0; i < bodies; ++i) out.push_back(body(world, i));
    return out;
  }

 private:
  SphereOf<Real> body(World world, int i) {
    const auto at = [&](double size) { return dice_.uniform(-size / 2, size / 2); };
    switch (world) {
      case World::gas: {
        const double size = side_ * world_scale_;
        return sphere<Real>(at(size), at(size), at(size), scale_ / 2);
      }
      case World::packed: {
        const auto cell = [&](int k) { return (k + at(0.3)) * scale_ * 0.98; };
        const int w = lattice_width_;
        return sphere<Real>(cell(i % w), cell(i / w % w), cell(i / w / w), scale_ / 2);
      }
      case World::mixed: {
        const double size = side_ * scale_;
        const double r = dice_.one_in(12) ? 0 : scale_ * std::pow(10.0, dice_.uniform(-3, 0));
        return sphere<Real>(at(size), at(size), at(size), r);
      }
      case World::point: {
        const double size = scale_ * 0.1;
        if (dice_.one_in(3)) return sphere<Real>(scale_, scale_, scale_, scale_ * 0.04);
        return sphere<Real>(scale_ + at(size), scale_ + at(size), scale_ + at(size), scale_ * 0.04);
      }
      case World::line: {
        const double size = side_ * side_ * side_ * scale_ * 0.8;
        const double t = at(size);
        if (line_mode_ == 0) return sphere<Real>(t, 0, 0, scale_ / 2);
        if (line_mode_ == 1) return sphere<Real>(t, t + at(scale_), -t, scale_ / 2);
        return sphere<Real>(at(std::sqrt(size * scale_)), at(std::sqrt(size * scale_)), scale_,
                            scale_ / 2);
      }
      case World::clusters: {
        const int which = dice_.integer(0, 4);
        const double far = 1e6 * scale_ * (which - 2);
        const double size = side_ * scale_;
        return sphere<Real>(far + at(size), (which % 2) * far + at(size), at(size), scale_ / 2);
      }
      case World::lattice: {
        const double step = lattice_mode_ == 0   ? scale_
                            : lattice_mode_ == 1 ? scale_ * (1 + 0x1p-7)
                                                 : scale_ * (1 + 0x1p-19) * (1 + 0x1p-7) / 2;
        const auto node = [&](int k) {
          return some_ulps(static_cast<Real>(k * step), dice_.integer(-3, 3));
        };
        const int w = lattice_width_;
        const Real r = some_ulps(static_cast<Real>(scale_ / 2), dice_.integer(-2, 2));
        return {node(dice_.integer(0, w)), node(dice_.integer(0, w)), node(dice_.integer(0, w)), r};
      }
      case World::extreme:
        break;
    }
    return extreme_body();
  }

  SphereOf<Real> extreme_body() {
    const bool is_float = sizeof(Real) == 4;
    const auto at = [&](double size) { return dice_.uniform(-size, size); };
    switch (extreme_mode_) {
      case 0: {  // squares of distances underflow
        const double size = is_float ? 1e-22 : 1e-160;
        const double r = dice_.one_in(2) ? 0 : size * 0.1;
        return sphere<Real>(at(size), at(size), at(size), r);
      }
      case 1: {  // near the limit
        const double size = is_float ? 0x1p61 : 0x1p509;
        return sphere<Real>(at(size), at(size), at(size), size * dice_.uniform(0, 0.1));
      }
      case 2:  // one giant among grains
        if (dice_.one_in(100)) return sphere<Real>(at(1), at(1), at(1), 1000);
        return sphere<Real>(at(40), at(40), at(40), dice_.uniform(0, 0.5));
      default: {  // far from the origin, where coordinates are coarse
        const double far = is_float ? 1e6 : 1e15;
        return sphere<Real>(far + at(2), -far + at(2), far + at(2), dice_.uniform(0, 0.2));
      }
    }
  }

  Dice dice_;
  double scale_ = 1, side_ = 1, world_scale_ = 1;
  int lattice_width_ = 2, lattice_mode_ = 0, line_mode_ = 0, extreme_mode_ = 0;
};

}  // namespace harpoon::testing
