#pragma once

// The random numbers of the worlds of ODE benchmarks: the same on every machine.

#include <cstdint>

namespace harpoon::bench {

/// SplitMix64 (Steele, Lea, Flood 2014).
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : state_(seed) {}
  /// Uniform in [-1, 1).
  double next() { return static_cast<double>(bits() >> 11) * 0x1p-52 - 1; }
  /// Uniform in [low, high).
  double between(double low, double high) { return low + (next() + 1) / 2 * (high - low); }
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t state_;
};

}  // namespace harpoon::bench
