#pragma once

// One collision of a space as a text file: what verification writes at a difference and `harpoon
// replay` takes up. Numbers are hexadecimal, so that they come back to the last bit. Of a
// sweep-and-prune space it does not hold the calls before, on which the order of equal bounds
// hangs.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harpoon/error.hpp"
#include "harpoon/records.hpp"
#include "ode/mirror.hpp"
#include "ode/options.hpp"

namespace harpoon::ode {

/// A geom as broad phases see it. Binary32 numbers are held exactly.
struct FrameGeom {
  int class_number = 0;
  std::uint32_t body = 0;  ///< number of its body; 0 is none
  std::uint64_t category = 0, collide = 0;
  double bounds[6] = {};
};

struct CollisionFrame {
  bool single_precision = false;
  Policy policy = Policy::compat;
  int kind = 0;  ///< class number of the space
  int min_level = 0, max_level = 0;
  int axis_order = 0;
  std::vector<FrameGeom> geoms;        ///< enabled ones, in the space's order
  std::vector<IndexPair> ours, stock;  ///< the sequences, by numbers of geoms
  std::string difference;              ///< one line about the first difference
};

std::string to_text(const CollisionFrame& frame);

/// Errors: invalid_argument (with the line), also when a pair names a geom that is not there.
Result<CollisionFrame> parse_frame(std::string_view text);

/// The frame's pairs by Harpoon's rules. Errors: as `PairSearch::find_simple`.
Result<std::vector<IndexPair>> search_again(const CollisionFrame& frame);

}  // namespace harpoon::ode
