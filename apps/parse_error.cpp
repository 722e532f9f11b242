#include "apps/parse_error.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <numeric>
#include <optional>

#include "apps/exit_code.hpp"
#include "apps/printable.hpp"

namespace harpoon::app {
namespace {

/// Letters to insert, remove or replace (Levenshtein's distance), by rows of its table.
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t corner = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = corner + (a[i] == b[j] ? 0 : 1);
      corner = row[j + 1];
      row[j + 1] = std::min({replaced, corner + 1, row[j] + 1});
    }
  }
  return row.back();
}

std::vector<std::string> known_to(const CLI::App& app) {
  std::vector<std::string> known;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    known.push_back(sub->get_name());
  }
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  return known;
}

const CLI::App& deepest(const CLI::App& root) {
  const CLI::App* used = &root;
  while (!used->get_subcommands().empty()) used = used->get_subcommands().front();
  return *used;
}

std::string path_of(const CLI::App& app) {
  return app.get_parent() == nullptr ? app.get_name()
                                     : path_of(*app.get_parent()) + " " + app.get_name();
}

[[noreturn]] void refuse_word(const CLI::App& app, const std::string& word) {
  throw CommandError(
      ExitCode::usage,
      fmt::format("{} is no command or option of {}. {}See `{} --help`.", in_quotes(word),
                  path_of(app), suggestion(word, known_to(app)), path_of(app)));
}

/// The first word that no command took.
std::optional<std::string> unknown_word(const CLI::App& app) {
  const std::vector<std::string> left = app.remaining();
  const auto word = std::find_if(left.begin(), left.end(), [](const auto& w) { return w != "--"; });
  return word == left.end() ? std::nullopt : std::optional(*word);
}

}  // namespace

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::size_t kLongest = 40;  // nobody's slip is longer
  const std::string* nearest = nullptr;
  std::size_t fewest = std::max<std::size_t>(2, std::min(word.size(), kLongest) / 3) + 1;
  for (const std::string& candidate : known) {
    const bool begins = word.size() > 1 && candidate.starts_with(word);
    const std::size_t distance = begins                   ? 1
                                 : word.size() > kLongest ? fewest
                                                          : edits(word, candidate);
    if (distance < fewest && distance < candidate.size()) {
      fewest = distance;
      nearest = &candidate;
    }
  }
  return nearest == nullptr ? "" : fmt::format("Did you mean {}? ", *nearest);
}

std::string answer_to(const CLI::App& root, const CLI::ParseError& error) {
  const CLI::App& used = deepest(root);
  // A word that is unknown speaks against a request for help, and explains what is missing.
  const int kind = error.get_exit_code();
  const bool is_request = kind == static_cast<int>(CLI::ExitCodes::Success);
  const bool is_about_words = is_request || kind == static_cast<int>(CLI::ExitCodes::ExtrasError) ||
                              kind == static_cast<int>(CLI::ExitCodes::RequiredError);
  const std::optional<std::string> unknown = unknown_word(used);
  if (is_about_words && unknown) refuse_word(used, *unknown);
  if (dynamic_cast<const CLI::CallForHelp*>(&error) != nullptr) return root.help();
  if (is_request) return fmt::format("{}\n", error.what());
  throw CommandError(ExitCode::usage,
                     fmt::format("{}. See `{} --help`.", error.what(), path_of(used)));
}

std::string help_of(const CLI::App& root, const std::vector<std::string>& path) {
  const CLI::App* app = &root;
  for (const std::string& word : path) {
    const auto subs =
        app->get_subcommands([&](const CLI::App* sub) { return sub->get_name() == word; });
    if (subs.empty()) refuse_word(*app, word);
    app = subs.front();
  }
  // App::help would answer for the command that was parsed.
  return app->get_formatter()->make_help(app, path_of(*app), CLI::AppFormatMode::Normal);
}

}  // namespace harpoon::app
