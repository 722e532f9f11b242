#pragma once

// One look at all bodies before anything is planned: which are valid, where most of them are, how
// large they are, and which few are so much larger that no grid should know them. A function of the
// set of bodies alone.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include "broad/kernels.hpp"
#include "broad/means.hpp"
#include "broad/plan.hpp"
#include "harpoon/error.hpp"

namespace harpoon::broad {

template <class Real>
struct Survey {
  Extremes<Real> extremes;
  Census census;                      ///< of the bodies that grids are made for
  Real largest = 0;                   ///< radius among them
  bool one_class = false;             ///< they are about equal in size
  std::vector<std::uint32_t> giants;  ///< valid bodies that are in no grid, ascending

  /// Bodies of the source that the grids leave out.
  [[nodiscard]] std::size_t left_out() const noexcept { return extremes.invalid + giants.size(); }
};

/// Of a number that is not negative: those of a class have one exponent.
template <class Real>
[[nodiscard]] inline int exponent_of(Real value) noexcept {
  using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
  Bits bits;
  std::memcpy(&bits, &value, sizeof bits);
  return static_cast<int>(bits << 1 >> std::numeric_limits<Real>::digits);
}

/// Powers of two between a radius and the largest one; below 0 for giants.
template <class Real>
class Classifier {
 public:
  explicit Classifier(Real largest) noexcept : top_(exponent_of(largest)) {}
  [[nodiscard]] int operator()(Real radius) const noexcept {
    return std::min(top_ - exponent_of(radius), static_cast<int>(kRadiusClasses) - 1);
  }

 private:
  int top_;
};

template <class Real>
[[nodiscard]] inline bool is_valid(const SphereOf<Real>& b) noexcept {
  const auto in_range = [](Real v) { return std::abs(v) <= kLimit<Real>; };  // false for NaN
  return in_range(b.x) && in_range(b.y) && in_range(b.z) && b.r >= 0 && b.r <= kLimit<Real>;
}

/// The radius of which all but about one in sixteen bodies have no more, by a sample.
template <class Real>
[[nodiscard]] double usual_radius(const Source<Real>& source) noexcept;

/// Ids of invalid bodies are appended to `excluded`. Throws std::bad_alloc only.
template <class Real>
std::optional<Error> survey(const Means& means, const Source<Real>& source, double margin,
                            std::vector<std::uint32_t>& excluded, Survey<Real>& out);

}  // namespace harpoon::broad
