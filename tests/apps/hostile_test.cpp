// Text from outside reaches a terminal only as printable lines, and every option of every
// subcommand has bounds: all bytes, in words, values, names of files and files; and all numbers
// that are none.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <filesystem>
#include <sstream>

#include "apps/command.hpp"
#include "apps/command_tree.hpp"
#include "apps/exit_code.hpp"
#include "apps/files.hpp"
#include "apps/invocations.hpp"
#include "apps/parse_error.hpp"
#include "apps/process.hpp"
#include "apps/scratch_folder.hpp"
#include "apps/shown_text.hpp"
#include "bench/json.hpp"

namespace harpoon::app {
namespace {

namespace fs = std::filesystem;

struct Declared {
  Context context;
  CLI::App root;
  CommandInfo info;

  Declared() {
    add_all_commands(root, context);
    info = describe_command(root);
  }
};

std::vector<std::string> words_of(const CommandInfo& command) {
  std::istringstream path(command.path);
  std::vector<std::string> words;
  for (std::string word; path >> word;) words.push_back(word);
  words.erase(words.begin());
  return words;
}

/// Every byte that a word of a command line can hold, in an order in which some are UTF-8.
std::string all_bytes(const char* without) {
  std::string bytes;
  for (int byte = 255; byte > 0; --byte) {
    if (std::string_view(without).find(static_cast<char>(byte)) == std::string_view::npos) {
      bytes += static_cast<char>(byte);
    }
  }
  return bytes;
}

void expect_printable(const std::string& text, const std::string& what) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    EXPECT_TRUE(is_fit_for_a_terminal(line)) << what;
    EXPECT_LE(line.size(), 8000U) << what;
  }
}

/// Nothing, or why the command line is refused.
std::string refusal(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  std::reverse(words.begin(), words.end());
  Declared declared;
  try {
    declared.root.parse(words);
  } catch (const CLI::ParseError& error) {
    try {
      answer_to(declared.root, error);
    } catch (const CommandError& refused) {
      EXPECT_EQ(refused.code(), ExitCode::usage);
      return refused.what();
    }
  }
  return "";
}

bool is_number(const OptionInfo& option) {
  return option.type.size() == 1;
}

TEST(Hostile, WordsAndValuesAreShownPrintable) {
  const Declared declared;
  const std::string bytes = all_bytes("");
  int options = 0;
  for (const CommandInfo* command : flattened(declared.info)) {
    const std::vector<std::string> words = words_of(*command);
    const auto run = [&](const std::vector<std::string>& more) {
      std::vector<std::string> all = words;
      all.insert(all.end(), more.begin(), more.end());
      const Finished f = run_piped(all);
      EXPECT_NE(f.exit_code, 0) << command->path << " " << more.front();
      EXPECT_LT(f.exit_code, 5) << command->path << " " << more.front();
      expect_printable(f.out + f.err, command->path + " " + more.front());
      EXPECT_EQ(std::count(f.err.begin(), f.err.end(), '\n'), 1) << f.err;
    };
    // `run` takes any word for its program, which is not there.
    run({bytes});
    if (command->path != "harpoon run") run({"--" + bytes});
    for (const OptionInfo& option : command->options) {
      // Names of files may be anything; they have a test of their own.
      if (option.is_positional || option.type.empty() || option.type == "FILE" ||
          option.type == "DIR" || command->path == "harpoon run") {
        continue;
      }
      run({option.names.back(), bytes});
      run({option.names.back() + "=" + std::string(5000000, 'x').substr(0, 100000)});
      ++options;
    }
  }
  EXPECT_GT(options, 40);
}

TEST(Hostile, NamesOfFilesAreShownPrintable) {
  const ScratchFolder folder;
  // Half of the bytes each, as a name of 255 must also hold what stands before it.
  const std::string bytes = all_bytes("/");
  const std::string halves[] = {bytes.substr(0, 127), bytes.substr(127)};
  for (const std::string& half : halves) {
    for (const Invocation& invocation : every_invocation(folder / "", half)) {
      if (invocation.files.empty()) continue;
      const Finished f = run_piped(invocation.arguments);
      EXPECT_EQ(f.exit_code, 0) << f.err;
      expect_printable(f.out + f.err, invocation.arguments[0]);
      for (const std::string& file : invocation.files) {
        EXPECT_TRUE(fs::exists(file)) << invocation.arguments[0];
        const std::string content = read_file(file);
        // JSON of a command line with such bytes is still JSON.
        EXPECT_TRUE(content.front() != '{' || bench::Json::accept(content)) << content;
      }
    }
    const std::string name = (folder / half.c_str()).string();
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"detect", name},
          {"replay", name},
          {"run", "--", name},
          {"diamond", "--out", (folder / "d").string(), "--against", name}}) {
      const Finished absent = run_piped(words);
      EXPECT_EQ(absent.exit_code, 3) << words[0];
      expect_printable(absent.out + absent.err, words[0]);
    }
    for (const char* first_line :
         {"x,y,z,r\n", "[", "harpoon-ode-frame 1\n", "step,sphere,x,y,z\n"}) {
      write_file(name, first_line + all_bytes("") + '\n');
      for (const char* command : {"detect", "replay"}) {
        const Finished f = run_piped({command, name});
        EXPECT_EQ(f.exit_code, 4) << command << f.err;
        expect_printable(f.out + f.err, command);
      }
    }
  }
}

TEST(Hostile, EveryByteInAFileIsShownPrintable) {
  const ScratchFolder folder;
  const std::string csv = (folder / "b.csv").string(), json = (folder / "b.json").string();
  for (int byte = 0; byte < 256; ++byte) {
    const std::string one(3, static_cast<char>(byte));
    write_file(csv, "x,y,z,r\n0,0,0," + one + "a\n");
    write_file(json, "[{\"x\":0,\"" + one + "\":1," + one + "}]");
    for (const std::string& file : {csv, json}) {
      const Finished f = run_piped({"detect", file});
      // Blank and comma are as good as any.
      EXPECT_EQ(f.exit_code, 4) << byte << f.err;
      expect_printable(f.out + f.err, std::to_string(byte));
    }
  }
}

TEST(Bounds, EveryNumberIsRefusedWhereItIsNone) {
  const Declared declared;
  int options = 0;
  for (const CommandInfo* command : flattened(declared.info)) {
    for (const OptionInfo& option : command->options) {
      if (option.is_positional || !is_number(option)) continue;
      ++options;
      for (const char* bad : {"nan", "inf", "-inf", "1e300", "-1e300", "18446744073709551616", "",
                              "ten", "1x", " 1", "0x10", "1,5x", "--1"}) {
        const std::string& name = option.names.back();
        const std::string why = *bad == '\0' ? refusal(words_of(*command), {name, bad})
                                             : refusal(words_of(*command), {name + "=" + bad});
        EXPECT_NE(why.find("number"), std::string::npos)
            << command->path << " " << option.names.back() << "=" << bad << ": " << why;
        EXPECT_NE(why.find(" from "), std::string::npos) << why;
      }
    }
  }
  EXPECT_GE(options, 25);
}

TEST(Bounds, AreTheOnesThatTheHelpStates) {
  const Declared declared;
  for (const CommandInfo* command : flattened(declared.info)) {
    for (const OptionInfo& option : command->options) {
      if (option.is_positional || !is_number(option)) continue;
      const std::string name = option.names.back();
      // 64 bits of a seed need no words.
      const std::size_t open = option.help.rfind('(');
      std::string low = "0", high = "18446744073709551615";
      if (name != "--seed") {
        ASSERT_NE(open, std::string::npos) << command->path << name;
        std::istringstream range(option.help.substr(open + 1));
        std::string to;
        range >> low >> to >> high;
        high.pop_back();
      }
      const auto why = [&](const std::string& value) {
        const std::string said = refusal(words_of(*command), {name + "=" + value});
        return said.find("number from") != std::string::npos;
      };
      EXPECT_FALSE(why(low)) << command->path << name << low;
      EXPECT_FALSE(why(high)) << command->path << name << high;
      EXPECT_TRUE(why(fmt::format("{}", std::stod(low) - 1))) << command->path << name;
      EXPECT_TRUE(why(fmt::format("{:.0f}", std::stod(high) * 2 + 1))) << command->path << name;
    }
  }
}

TEST(Bounds, ANameIsNeverEmpty) {
  const Declared declared;
  int options = 0;
  for (const CommandInfo* command : flattened(declared.info)) {
    for (const OptionInfo& option : command->options) {
      if (option.is_positional || (option.type != "FILE" && option.type != "DIR")) continue;
      EXPECT_NE(refusal(words_of(*command), {option.names.back(), ""}).find("empty"),
                std::string::npos)
          << command->path << option.names.back();
      ++options;
    }
  }
  EXPECT_GE(options, 12);
}

}  // namespace
}  // namespace harpoon::app
