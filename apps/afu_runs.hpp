#pragma once

// What `harpoon afu` shows: a small transaction of every format on the AFU, what it counted, and
// how fast it was simulated. Every result is compared with the scalar collider.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/afu_entry.hpp"

namespace harpoon::app {

struct AfuRunsPlan {
  std::string profile = kDefaultAfuProfile;
  std::size_t pairs = 10000;          ///< in each run; 0 is legal
  unsigned direct_hit_percent = 50;   ///< pairs that overlap, direct formats
  unsigned indexed_hit_percent = 10;  ///< the same, indexed format
  std::uint64_t seed = 1;
  /// Takes a VCD of the direct run piece by piece; must not throw. Empty: none.
  std::function<void(std::string_view)> waveform;
};

/// The published AFU, as far as two registers can bring it back: few lines in flight, and a barrier
/// after every batch of N pairs.
inline constexpr afu::PucSettings kPublishedBehaviour = {4, true};
inline constexpr std::size_t kMostPublishedPairs = 1000;

struct AfuRun {
  std::string name;  ///< "direct", "direct, hits only", ...
  afu::AfuReport report;
  double wall_ns = 0;    ///< measured: how long the batch took here
  std::string mismatch;  ///< empty when every result is right
};

/// An empty batch, one of each format, and the direct format with the published behaviour.
/// Throws CommandError when there is no AFU or it fails.
std::vector<AfuRun> run_afu(const AfuRunsPlan& plan);

/// Spheres of two, far from all others; a pair of the batch names such two or two of different
/// ones.
struct AfuWorkload {
  std::vector<Sphere> spheres;
  std::vector<IndexPair> pairs;
};

/// As many spheres as the table of the AFU in this tree holds.
inline constexpr std::size_t kMostAfuSpheres = 16384;

/// `hit_percent` of the pairs overlap, up to chance; the same for the same seed. `spheres` >= 4.
AfuWorkload make_afu_workload(std::size_t spheres, std::size_t pairs, unsigned hit_percent,
                              std::uint64_t seed);

/// As the RTL calls it: "direct", "direct_hits", "indexed_hits".
std::string_view format_name(afu::contract::Format format);

}  // namespace harpoon::app
