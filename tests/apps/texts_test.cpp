// The manual page and the completions say what the parser accepts, and the shells accept them.

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>

#include "apps/command.hpp"
#include "apps/completion.hpp"
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
  EXPECT_NE(page.find("130"), std::string::npos);
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
  EXPECT_EQ(offered(folder, "harpoon bench pa"), "pairs\n");
  EXPECT_EQ(offered(folder, "harpoon bench pairs --fo"), "--format\n");
  EXPECT_EQ(offered(folder, "harpoon bench pairs --type g"), "grazing\n");
  EXPECT_EQ(offered(folder, "harpoon completion \"\""), "-h --help bash zsh fish\n");
  EXPECT_EQ(offered(folder, "harpoon bench pairs --json " + (folder / "da").string()),
            (folder / "data.json").string() + "\n");
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
