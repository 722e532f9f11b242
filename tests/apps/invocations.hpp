#pragma once

// Every subcommand, in every way in which it reads or writes, at its quickest: for tests of what
// all of them must do.

#include <filesystem>
#include <string>
#include <vector>

namespace harpoon::app {

struct Invocation {
  std::vector<std::string> arguments;
  std::vector<std::string> files;  ///< that it writes, with their folder
  bool is_repeatable = true;       ///< writes the same each time
  bool makes_csv = false;          ///< appends to its last file

  [[nodiscard]] std::string name() const;
};

/// Writes what they read into the folder. The files that they write end with `suffix`.
std::vector<Invocation> every_invocation(const std::filesystem::path& folder,
                                         const std::string& suffix = "");

}  // namespace harpoon::app
