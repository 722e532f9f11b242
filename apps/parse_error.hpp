#pragma once

// What to say when a command line is not understood: which word is to blame, and what may have been
// meant.

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): it is the name CLI11 chose
class App;
class ParseError;
}  // namespace CLI

namespace harpoon::app {

/// Where `error` stands for a request (help, version) that nothing speaks against: what to print.
/// Throws CommandError (usage) for all others.
std::string answer_to(const CLI::App& root, const CLI::ParseError& error);

/// The help of the command at the end of `path`, below `root`. Throws CommandError (usage) where
/// there is none.
std::string help_of(const CLI::App& root, const std::vector<std::string>& path);

/// "Did you mean X? " for the nearest of `known`, or nothing where none is near.
std::string suggestion(const std::string& word, const std::vector<std::string>& known);

}  // namespace harpoon::app
