#pragma once

// Four floats side by side, as compilers have them everywhere: the library is built for the oldest
// machine that it serves.

#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace harpoon::ode {

inline constexpr std::size_t kLanes = 4;
using LaneFloats __attribute__((vector_size(kLanes * sizeof(float)))) = float;
/// What comparing them gives: all bits of a lane or none.
using LaneBits __attribute__((vector_size(kLanes * sizeof(float)))) = std::int32_t;

/// Need not be aligned.
inline LaneFloats load_lanes(const float* values) {
  LaneFloats lanes;
  std::memcpy(&lanes, values, sizeof lanes);
  return lanes;
}

/// One bit for each lane, the first the lowest.
inline unsigned mask_of(LaneBits lanes) {
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(lanes)));
#else
  unsigned mask = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) mask |= (lanes[lane] & 1) << lane;
  return mask;
#endif
}

}  // namespace harpoon::ode
