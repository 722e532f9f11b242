#include "bench/pair_cases.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace harpoon::bench {
namespace {

template <class Real>
class PairMaker {
 public:
  PairMaker(std::uint64_t seed, bool finite) : engine_(seed), finite_(finite) {}

  SpherePairOf<Real> make(std::size_t index) {
    switch (index % 8) {
      case 2:
        return apart();
      case 3:
        return coincident();
      case 4:
        return touching();
      case 5:
        return extreme();
      case 6:
        return points();
      case 7:
        return finite_ ? overlapping() : special();
      default:
        return overlapping();
    }
  }

 private:
  using Pair = SpherePairOf<Real>;

  Real uniform(double low, double high) {
    return static_cast<Real>(low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53);
  }

  Pair overlapping() {
    const Real x = uniform(-10, 10);
    const Real y = uniform(-10, 10);
    const Real z = uniform(-10, 10);
    const Real r1 = uniform(0.5, 1);
    const Real r2 = uniform(0.5, 1);
    return {{x, y, z, r1},
            {x + uniform(-0.5, 0.5), y + uniform(-0.5, 0.5), z + uniform(-0.5, 0.5), r2}};
  }

  Pair apart() {
    Pair pair = overlapping();
    pair.s2.x += uniform(3, 100);
    return pair;
  }

  Pair coincident() {
    Pair pair = overlapping();
    pair.s2.x = pair.s1.x;
    pair.s2.y = pair.s1.y;
    pair.s2.z = pair.s1.z;
    return pair;
  }

  // Radii whose sum is the distance, give or take three units in the last place.
  Pair touching() {
    Pair pair = overlapping();
    const Real dx = pair.s1.x - pair.s2.x;
    const Real dy = pair.s1.y - pair.s2.y;
    const Real dz = pair.s1.z - pair.s2.z;
    const Real d = std::sqrt(dx * dx + dy * dy + dz * dz);
    pair.s1.r = d * uniform(0.1, 0.9);
    pair.s2.r = d - pair.s1.r;
    const Real toward = (engine_() & 1) != 0 ? Real(0) : std::numeric_limits<Real>::max();
    for (std::uint64_t steps = engine_() % 4; steps > 0; --steps) {
      pair.s2.r = std::nextafter(pair.s2.r, toward);
    }
    return pair;
  }

  // Magnitudes over the whole range of exponents, so squares overflow and underflow.
  Pair extreme() {
    Pair pair = overlapping();
    const int range = std::numeric_limits<Real>::max_exponent - 8;
    const int exponent =
        static_cast<int>(engine_() % static_cast<std::uint64_t>(2 * range)) - range;
    for (SphereOf<Real>* s : {&pair.s1, &pair.s2}) {
      s->x = std::ldexp(s->x, exponent);
      s->y = std::ldexp(s->y, exponent);
      s->z = std::ldexp(s->z, exponent);
      s->r = std::ldexp(s->r, exponent);
    }
    return pair;
  }

  Pair points() {
    Pair pair = (engine_() & 1) != 0 ? coincident() : overlapping();
    pair.s1.r = 0;
    pair.s2.r = (engine_() & 1) != 0 ? Real(0) : pair.s2.r;
    return pair;
  }

  Pair special() {
    using Limits = std::numeric_limits<Real>;
    const std::array<Real, 8> values = {
        Real(0),    Real(-0.0),    Limits::denorm_min(), Real(1),
        Real(1e30), Limits::max(), Limits::infinity(),   Limits::quiet_NaN()};
    std::array<Real, 8> v;
    for (Real& number : v) {
      number = values[engine_() % values.size()];
    }
    return {{v[0], v[1], v[2], v[3]}, {v[4], v[5], v[6], v[7]}};
  }

  std::mt19937_64 engine_;
  bool finite_;
};

}  // namespace

template <class Real>
std::vector<SpherePairOf<Real>> hard_pairs(std::uint64_t seed, std::size_t count, bool finite) {
  PairMaker<Real> maker(seed, finite);
  std::vector<SpherePairOf<Real>> pairs;
  pairs.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    pairs.push_back(maker.make(i));
  }
  return pairs;
}

template std::vector<SpherePair> hard_pairs<float>(std::uint64_t, std::size_t, bool);
template std::vector<SpherePairF64> hard_pairs<double>(std::uint64_t, std::size_t, bool);

}  // namespace harpoon::bench
