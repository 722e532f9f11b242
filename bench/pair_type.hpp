#pragma once

// The paper's types of collision (section III.C), and the mix of them that a broad phase delivers.

#include <cstdint>
#include <optional>
#include <string_view>

#include "harpoon/records.hpp"

namespace harpoon::bench {

enum class PairType : std::uint8_t {
  fake,     ///< Flow 1: apart
  grazing,  ///< Flow 2: centres coincide
  real,     ///< Flow 3: overlapping or touching
  mixed,    ///< every candidate pair, as it comes
};

/// "fake", "grazing", "real", "mixed". Static storage.
std::string_view to_string(PairType type);
std::optional<PairType> parse_pair_type(std::string_view name);

/// Does a pair that went this way belong to the type?
bool matches(PairType type, Flow flow);

}  // namespace harpoon::bench
