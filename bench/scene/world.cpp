#include "bench/scene/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

namespace harpoon::bench {
namespace {

constexpr std::array<std::pair<std::string_view, WorldKind>, 6> kNames = {{
    {"gas", WorldKind::gas},
    {"packed", WorldKind::packed},
    {"polydisperse", WorldKind::polydisperse},
    {"bed", WorldKind::bed},
    {"diamond", WorldKind::diamond},
    {"clusters", WorldKind::clusters},
}};
constexpr double kStepOverRadius = 0.02;
constexpr double kClusterDistance = 1e6;

/// SplitMix64: the same numbers on every machine.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : state_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53;
  }
  std::size_t below(std::size_t count) { return next() % count; }

 private:
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15U);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

using Spheres = std::vector<SphereF64>;

double volume(const Spheres& spheres) {
  double sum = 0;
  for (const SphereF64& s : spheres) sum += 4.0 / 3 * std::numbers::pi * s.r * s.r * s.r;
  return sum;
}

void scatter(Spheres& spheres, double fraction, Numbers& numbers) {
  const double side = std::cbrt(volume(spheres) / fraction);
  for (SphereF64& s : spheres) {
    s.x = numbers.uniform(0, side);
    s.y = numbers.uniform(0, side);
    s.z = numbers.uniform(0, side);
  }
}

/// A cubic lattice of the given volume fraction, every body up to a fifth of a step off its node.
void pack(Spheres& spheres, std::size_t begin, std::size_t end, double fraction, double x,
          Numbers& numbers) {
  const auto width =
      static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(end - begin))));
  const double step = 2 * spheres[begin].r * std::cbrt(std::numbers::pi / 6 / fraction);
  for (std::size_t i = begin; i < end; ++i) {
    const std::size_t k = i - begin;
    const auto node = [&](std::size_t n) {
      return (static_cast<double>(n) + numbers.uniform(-0.2, 0.2)) * step;
    };
    spheres[i].x = x + node(k % width);
    spheres[i].y = x + node(k / width % width);
    spheres[i].z = x + node(k / width / width);
  }
}

/// A face-centred cubic lattice: every second node of a cubic one. Bodies are moved so far off
/// their nodes that about a third of neighbours touch.
void lay_bed(Spheres& spheres, Numbers& numbers) {
  constexpr double kFraction = 0.72;
  constexpr double kJitter = 0.044;  // of the radius
  const double radius = spheres[0].r;
  const double step = radius * std::cbrt(2 * std::numbers::pi / 3 / kFraction);
  const auto width =
      static_cast<std::size_t>(std::ceil(std::cbrt(2 * static_cast<double>(spheres.size()))));
  std::size_t n = 0;
  for (std::size_t node = 0; n < spheres.size(); ++node) {
    const std::size_t i = node % width;
    const std::size_t j = node / width % width;
    const std::size_t k = node / width / width;
    if ((i + j + k) % 2 != 0) continue;
    const auto at = [&](std::size_t index) {
      return static_cast<double>(index) * step + numbers.uniform(-kJitter, kJitter) * radius;
    };
    spheres[n++] = {at(i), at(j), at(k), radius};
  }
}

/// Shells of the diamond |i| + |j| + |k| = h, from the centre out.
void diamond(Spheres& spheres) {
  std::size_t n = 0;
  for (int h = 0; n < spheres.size(); ++h) {
    for (int i = -h; i <= h && n < spheres.size(); ++i) {
      const int rest = h - std::abs(i);
      for (int j = -rest; j <= rest && n < spheres.size(); ++j) {
        const int k = rest - std::abs(j);
        for (const int z : {k, -k}) {
          if (n < spheres.size() && (z == k || k != 0)) {
            spheres[n++] = {static_cast<double>(i), static_cast<double>(j), static_cast<double>(z),
                            0.5};
          }
        }
      }
    }
  }
}

void shuffle(Spheres& spheres, Numbers& numbers) {
  for (std::size_t i = spheres.size(); i > 1; --i) {
    std::swap(spheres[i - 1], spheres[numbers.below(i)]);
  }
}

}  // namespace

std::optional<WorldKind> parse_world_kind(std::string_view name) {
  for (const auto& [known, kind] : kNames) {
    if (known == name) return kind;
  }
  return std::nullopt;
}

std::string_view to_string(WorldKind kind) {
  for (const auto& [name, known] : kNames) {
    if (known == kind) return name;
  }
  return "unknown";
}

MovingWorld::MovingWorld(WorldKind kind, std::size_t bodies, std::uint64_t seed)
    : start_(bodies, SphereF64{0, 0, 0, 0.5}), step_(bodies) {
  Numbers numbers(seed);
  switch (kind) {
    case WorldKind::gas:
      scatter(start_, 0.05, numbers);
      break;
    case WorldKind::packed:
      if (bodies != 0) pack(start_, 0, bodies, 0.55, 0, numbers);
      break;
    case WorldKind::polydisperse:
      for (SphereF64& s : start_) s.r = std::exp(numbers.uniform(std::log(0.05), 0));
      scatter(start_, 0.2, numbers);
      break;
    case WorldKind::bed:
      if (bodies != 0) lay_bed(start_, numbers);
      break;
    case WorldKind::diamond:
      diamond(start_);
      break;
    case WorldKind::clusters:
      if (bodies >= 2) {
        pack(start_, 0, bodies / 2, 0.55, 0, numbers);
        pack(start_, bodies / 2, bodies, 0.55, kClusterDistance, numbers);
      }
      break;
  }
  shuffle(start_, numbers);
  for (std::size_t i = 0; i < bodies; ++i) {
    Step s;
    double square;
    do {
      s = {numbers.uniform(-1, 1), numbers.uniform(-1, 1), numbers.uniform(-1, 1)};
      square = s.x * s.x + s.y * s.y + s.z * s.z;
    } while (square > 1 || square < 1e-6);
    const double scale = kStepOverRadius * start_[i].r / std::sqrt(square);
    step_[i] = {s.x * scale, s.y * scale, s.z * scale};
  }
}

void MovingWorld::at(unsigned frame, std::vector<Sphere>& out) const {
  out.resize(start_.size());
  for (std::size_t i = 0; i < start_.size(); ++i) {
    const SphereF64& s = start_[i];
    out[i] = {static_cast<float>(s.x + frame * step_[i].x),
              static_cast<float>(s.y + frame * step_[i].y),
              static_cast<float>(s.z + frame * step_[i].z), static_cast<float>(s.r)};
  }
}

}  // namespace harpoon::bench
