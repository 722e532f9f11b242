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

/// A box as the scene takes it: min x, max x, min y, max y, min z, max z.
template <class Real>
using Box = std::array<Real, 6>;

/// What was done to the boxes of a world beyond bounding its spheres.
enum class BoxKind : std::uint8_t { cube, long_side, flat, touching, infinite, huge, invalid };
inline constexpr std::size_t kBoxKinds = 7;

/// Boxes around the spheres of a world. `odd` of 100 are stretched, flattened, snapped to numbers
/// that others share, made infinite, huge or invalid; `seen` counts the kinds.
template <class Real>
std::vector<Box<Real>> boxes_around(const std::vector<SphereOf<Real>>& spheres, std::uint64_t seed,
                                    int odd, std::array<int, kBoxKinds>& seen) {
  const Real infinity = std::numeric_limits<Real>::infinity();
  Dice dice(seed);
  std::vector<Box<Real>> out;
  for (const SphereOf<Real>& s : spheres) {
    Box<Real> b = {s.x - s.r, s.x + s.r, s.y - s.r, s.y + s.r, s.z - s.r, s.z + s.r};
    const auto axis = static_cast<std::size_t>(2 * dice.integer(0, 2));
    auto kind = BoxKind::cube;
    if (dice.integer(1, 100) <= odd) {
      kind = static_cast<BoxKind>(dice.integer(1, 4));
      if (dice.one_in(20)) kind = dice.one_in(2) ? BoxKind::huge : BoxKind::invalid;
      if (kind == BoxKind::infinite && !dice.one_in(10)) kind = BoxKind::long_side;
    }
    switch (kind) {
      case BoxKind::cube:
        break;
      case BoxKind::long_side:
        b[axis] -= s.r * static_cast<Real>(dice.uniform(0, 30));
        b[axis + 1] += s.r * static_cast<Real>(dice.uniform(0, 30));
        break;
      case BoxKind::flat:
        b[axis] = b[axis + 1];
        break;
      case BoxKind::touching: {
        if (out.empty()) break;
        // A face of an earlier box becomes the opposite one of this box.
        const auto& other =
            out[static_cast<std::size_t>(dice.integer(0, static_cast<int>(out.size()) - 1))];
        if (other[axis + 1] <= b[axis + 1]) b[axis] = other[axis + 1];
        break;
      }
      case BoxKind::infinite:
        if (dice.one_in(2)) b[axis] = -infinity;
        if (dice.one_in(2)) b[axis + 1] = infinity;
        if (dice.one_in(8)) b[axis] = b[axis + 1];
        break;
      case BoxKind::huge:
        for (std::size_t k = 0; k < 6; ++k) b[k] += (k % 2 == 0 ? -1000 : 1000) * s.r;
        break;
      case BoxKind::invalid:
        if (dice.one_in(2)) {
          b[axis] = std::numeric_limits<Real>::quiet_NaN();
        } else {
          b[axis] = b[axis + 1] + 1 + std::abs(b[axis + 1]);
        }
        break;
    }
    ++seen[static_cast<std::size_t>(kind)];
    out.push_back(b);
  }
  return out;
}

}  // namespace harpoon::testing
