#include "bench/pair_type.hpp"

#include <array>
#include <cstddef>

namespace harpoon::bench {
namespace {

constexpr std::array<std::string_view, 4> kNames = {"fake", "grazing", "real", "mixed"};

}  // namespace

std::string_view to_string(PairType type) {
  return kNames[static_cast<std::size_t>(type)];
}

std::optional<PairType> parse_pair_type(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) {
      return static_cast<PairType>(i);
    }
  }
  return std::nullopt;
}

bool matches(PairType type, Flow flow) {
  switch (type) {
    case PairType::fake:
      return flow == Flow::fake;
    case PairType::grazing:
      return flow == Flow::grazing;
    case PairType::real:
      return flow == Flow::real;
    case PairType::mixed:
      return true;
  }
  return false;
}

}  // namespace harpoon::bench
