#pragma once

// The JSON of the nouns that several outputs share.

#include <nlohmann/json.hpp>

#include "bench/results.hpp"

namespace harpoon::bench {

/// Keeps the order in which fields are written.
using Json = nlohmann::ordered_json;

Json machine_json(const Machine& machine);
Json row_json(const ResultRow& row);

}  // namespace harpoon::bench
