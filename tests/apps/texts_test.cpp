// The manual page and the completions say what the parser accepts, and the shells accept them.

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdlib>
#include <set>
#include <sstream>

#include "apps/command.hpp"
#include "apps/completion.hpp"
#include "apps/exit_code.hpp"
#include "apps/files.hpp"
#include "apps/manual.hpp"
#include "apps/process.hpp"
#include "apps/scratch_folder.hpp"

namespace harpoon::app {
namespace {

struct Declared {
  Context context;
  CLI::App root;
  CommandInfo info;

  Declared() {
    add_all_commands(root, context);
    info = describe_command(root);
  }
};

bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

// What bash offers after `words`, the last of which is being typed.
std::string offered(const ScratchFolder& folder, const std::string& words) {
  const std::string script = (folder / "harpoon.bash").string();
  const std::string output = (folder / "offered").string();
  const std::string command = "bash -c 'source " + script + "; COMP_WORDS=(" + words +
                              "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _harpoon; "
                              "echo \"${COMPREPLY[@]}\"' > " +
                              output;
  EXPECT_EQ(std::system(command.c_str()), 0);
  return read_file(output);
}

TEST(CommandTree, HoldsEveryCommandAndOption) {
  const Declared declared;
  std::vector<std::string> paths;
  for (const CommandInfo* command : flattened(declared.info)) {
    paths.push_back(command->path);
    EXPECT_FALSE(command->help.empty()) << command->path;
    EXPECT_NE(command->footer.find("Example"), std::string::npos) << command->path;
    for (const OptionInfo& option : command->options) {
      EXPECT_FALSE(option.help.empty()) << command->path;
      EXPECT_FALSE(option.names.empty()) << command->path;
    }
  }
  for (const char* path :
       {"harpoon", "harpoon demo", "harpoon bench", "harpoon bench pairs", "harpoon diamond",
        "harpoon afu", "harpoon devices", "harpoon selftest"}) {
    EXPECT_NE(std::find(paths.begin(), paths.end(), path), paths.end()) << path;
  }
}

TEST(Manual, NamesEveryCommandAndOption) {
  const Declared declared;
  const std::string page = manual_page(declared.info, "1.2.3");
  EXPECT_EQ(page.substr(0, 14), ".TH HARPOON 1 ");
  for (const CommandInfo* command : flattened(declared.info)) {
    EXPECT_NE(page.find(roff_escaped(command->path)), std::string::npos) << command->path;
    for (const OptionInfo& option : command->options) {
      EXPECT_NE(page.find(roff_escaped(option.names.back())), std::string::npos)
          << option.names.back();
    }
  }
  EXPECT_NE(page.find("NO_COLOR"), std::string::npos);
}

/// Codes of a table or list: numbers at the beginning of lines.
std::set<int> codes_in(const std::string& text) {
  std::set<int> codes;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of("| ");
    if (first == std::string::npos || first > 2) continue;
    for (const char* at = line.c_str() + first; std::isdigit(*at) != 0;) {
      codes.insert(static_cast<int>(std::strtol(at, const_cast<char**>(&at), 10)));
      if (*at == ',') at += 2;
    }
  }
  return codes;
}

TEST(ExitCodes, AreTheSameInHelpManualDocumentAndCode) {
  const Declared declared;
  const std::string& help = declared.info.footer;
  const std::string list = help.substr(0, help.find("Environment:"));
  const std::string document = read_file(HARPOON_COMMAND_DOCUMENT);
  const std::size_t table = document.find("## Exit codes");
  const std::set<int> codes = codes_in(list);
  EXPECT_EQ(codes, codes_in(document.substr(table, document.find("\n## ", table + 1) - table)));
  const std::string page = manual_page(declared.info, "1.2.3");
  EXPECT_EQ(codes, codes_in(page.substr(page.find("Exit codes:"))));
  for (const ExitCode code : {ExitCode::ok, ExitCode::failure, ExitCode::usage,
                              ExitCode::environment, ExitCode::data, ExitCode::not_served}) {
    EXPECT_TRUE(codes.contains(static_cast<int>(code)));
  }
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) EXPECT_TRUE(codes.contains(128 + signal));
}

TEST(Manual, EscapesWhatRoffWouldTake) {
  EXPECT_EQ(roff_escaped(".a\n'b\\c--d"), "\\&.a\n\\&'b\\ec\\-\\-d");
}

TEST(Manual, IsAcceptedByGroffWithoutAWarning) {
  if (!has_program("groff")) {
    GTEST_SKIP() << "groff is not installed";
  }
  const Declared declared;
  const ScratchFolder folder;
  write_file(folder / "harpoon.1", manual_page(declared.info, "1.2.3"));
  const std::string command = "groff -man -Tascii -ww -z " + (folder / "harpoon.1").string() +
                              " > " + (folder / "log").string() + " 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(read_file(folder / "log"), "");
}

TEST(Completion, BashOffersCommandsOptionsChoicesAndFiles) {
  const Declared declared;
  const ScratchFolder folder;
  write_file(folder / "harpoon.bash", bash_completion(declared.info));
  write_file(folder / "data.json", "");
  EXPECT_EQ(offered(folder, "harpoon de"), "demo detect devices\n");
  EXPECT_EQ(offered(folder, "harpoon help de"), "demo detect devices\n");
  EXPECT_EQ(offered(folder, "harpoon bench pa"), "pairs\n");
  EXPECT_EQ(offered(folder, "harpoon bench pairs --fo"), "--format\n");
  EXPECT_EQ(offered(folder, "harpoon bench pairs --type g"), "grazing\n");
  EXPECT_EQ(offered(folder, "harpoon completion \"\""), "-h --help bash zsh fish\n");
  EXPECT_EQ(offered(folder, "harpoon bench pairs --json " + (folder / "da").string()),
            (folder / "data.json").string() + "\n");
}

TEST(Completion, BashOffersFilesForEveryFileAndCommandsForACommand) {
  const Declared declared;
  const ScratchFolder folder;
  write_file(folder / "harpoon.bash", bash_completion(declared.info));
  write_file(folder / "data.json", "");
  const std::string begun = (folder / "da").string();
  int files = 0;
  for (const CommandInfo* command : flattened(declared.info)) {
    for (const OptionInfo& option : command->options) {
      if (option.type != "FILE") continue;
      const std::string before = option.is_positional ? "" : " " + option.names.back();
      EXPECT_EQ(offered(folder, command->path + before + " " + begun),
                (folder / "data.json").string() + "\n")
          << command->path << before;
      ++files;
    }
  }
  EXPECT_GE(files, 9);
  // As often as there are folders with it.
  EXPECT_EQ(offered(folder, "harpoon run mkfif").substr(0, 6), "mkfifo");
  EXPECT_EQ(offered(folder, "harpoon run -- mkfif").substr(0, 6), "mkfifo");
  EXPECT_EQ(offered(folder, "harpoon run " + begun), (folder / "data.json").string() + "\n");
}

TEST(Completion, FishOffersFilesForEveryFileAndCommandsForACommand) {
  if (!has_program("fish")) GTEST_SKIP() << "fish is not installed";
  const Declared declared;
  const ScratchFolder folder;
  write_file(folder / "harpoon.fish", fish_completion(declared.info));
  write_file(folder / "data.json", "");
  std::string lines = "harpoon run mkfif\n";
  std::size_t files = 0;
  for (const CommandInfo* command : flattened(declared.info)) {
    for (const OptionInfo& option : command->options) {
      if (option.type != "FILE") continue;
      const std::string before = option.is_positional ? "" : " " + option.names.back();
      lines += command->path + before + " da\n";
      ++files;
    }
  }
  write_file(folder / "lines", lines);
  const std::string script = "cd " + folder.string() +
                             "; source harpoon.fish; while read line; complete -C $line; end"
                             " < lines > offered 2>&1";
  EXPECT_EQ(std::system(("fish --no-config -c '" + script + "'").c_str()), 0);
  const std::string offered_lines = read_file(folder / "offered");
  EXPECT_EQ(offered_lines.substr(0, 6), "mkfifo") << offered_lines;
  std::size_t found = 0;
  for (std::size_t at = 0; (at = offered_lines.find("data.json\n", at)) != std::string::npos;
       ++at) {
    ++found;
  }
  EXPECT_EQ(found, files) << offered_lines;
}

TEST(Completion, EveryShellsScriptNamesEveryOptionAndParses) {
  const Declared declared;
  const ScratchFolder folder;
  const std::pair<const char*, std::string> scripts[] = {{"bash", bash_completion(declared.info)},
                                                         {"zsh", zsh_completion(declared.info)},
                                                         {"fish", fish_completion(declared.info)}};
  for (const auto& [shell, script] : scripts) {
    for (const CommandInfo* command : flattened(declared.info)) {
      for (const OptionInfo& option : command->options) {
        if (option.is_positional && option.choices.empty()) {
          continue;  // a file name of the user's
        }
        std::string name = option.is_positional ? option.choices.back() : option.names.back();
        name = name.substr(name.find_first_not_of('-'));
        EXPECT_NE(script.find(name), std::string::npos) << shell << " " << name;
      }
    }
    if (has_program(shell)) {
      write_file(folder / shell, script);
      const std::string check = std::string(shell) + " -n " + (folder / shell).string();
      EXPECT_EQ(std::system(check.c_str()), 0);
    }
  }
}

TEST(Texts, TheCommandPrintsThem) {
  const Declared declared;
  EXPECT_EQ(run_piped({"completion", "bash"}).out, bash_completion(declared.info));
  EXPECT_EQ(run_piped({"completion", "zsh"}).out, zsh_completion(declared.info));
  EXPECT_EQ(run_piped({"completion", "fish"}).out, fish_completion(declared.info));
  EXPECT_NE(run_piped({"manual"}).out.find(".SH COMMANDS"), std::string::npos);
}

}  // namespace
}  // namespace harpoon::app
