#pragma once

// The JSON of the nouns that several outputs share.

#include <nlohmann/json.hpp>

#include "bench/results.hpp"

namespace harpoon::bench {

/// Keeps the order in which fields are written.
using Json = nlohmann::ordered_json;

Json machine_json(const Machine& machine);
/// What every document of results begins with: machine, commit, date and command.
Json head_json(const Machine& machine, const std::string& commit, const std::string& date,
               const std::string& command);
/// "before", "after", "waiting", "busy"; null where the kernel does not tell.
Json load_json(const MachineLoad& load);
Json row_json(const ResultRow& row);

}  // namespace harpoon::bench
