#include "apps/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

// All three scripts work alike: they walk the words typed so far down the tree of commands, offer
// the values of the option before the cursor if it takes one, and otherwise the subcommands and
// options of the command they arrived at.

namespace harpoon::app {
namespace {

// For use inside single quotes of a POSIX-like shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
    } else {
      out += c;
    }
  }
  return out + "'";
}

// 'harpoon demo'|'harpoon bench'|... : the paths below the root.
std::string path_patterns(const CommandInfo& root) {
  std::vector<std::string> patterns;
  for (const CommandInfo* command : flattened(root)) {
    if (command != &root) {
      patterns.push_back(quoted(command->path));
    }
  }
  return fmt::format("{}", fmt::join(patterns, "|"));
}

// 'harpoon demo --out'|'harpoon demo -o' : the option's names behind the command.
std::string option_patterns(const CommandInfo& command, const OptionInfo& option) {
  std::vector<std::string> patterns;
  for (const std::string& name : option.names) {
    patterns.push_back(quoted(command.path + " " + name));
  }
  return fmt::format("{}", fmt::join(patterns, "|"));
}

// Is the word behind the option its value?
bool takes_value(const OptionInfo& option) {
  return !option.is_positional && !option.type.empty();
}

/// What stands at the end of a command line by its place: "FILE", "COMMAND", or "".
std::string positional_type(const CommandInfo& command) {
  for (const OptionInfo& option : command.options) {
    if (option.is_positional && option.choices.empty()) return option.type;
  }
  return "";
}

std::vector<std::string> words_of(const CommandInfo& command) {
  std::vector<std::string> words;
  for (const CommandInfo& sub : command.subcommands) {
    words.push_back(sub.name);
  }
  for (const OptionInfo& option : command.options) {
    const std::vector<std::string>& offered = option.is_positional ? option.choices : option.names;
    words.insert(words.end(), offered.begin(), offered.end());
  }
  return words;
}

// Name and help for zsh's _describe: colons separate the two.
std::string described(const std::string& name, const std::string& help) {
  std::string text = name + ":";
  for (const char c : help) {
    if (c == ':') {
      text += '\\';
    }
    text += c;
  }
  return quoted(text);
}

std::string bash_values(const OptionInfo& option) {
  if (option.type == "FILE") {
    return "COMPREPLY=($(compgen -f -- \"$word\"))";
  }
  if (option.type == "DIR") {
    return "COMPREPLY=($(compgen -d -- \"$word\"))";
  }
  return fmt::format("COMPREPLY=($(compgen -W '{}' -- \"$word\"))", fmt::join(option.choices, " "));
}

/// Adds to what is offered for a word that is no option.
std::string bash_positional(const CommandInfo& command) {
  const std::string type = positional_type(command);
  if (type == "FILE") return "; more=-f";
  return type == "COMMAND" ? "; more='-c -f'" : "";
}

std::string zsh_positional(const CommandInfo& command) {
  const std::string type = positional_type(command);
  if (type == "FILE") return "; _files";
  return type == "COMMAND" ? "; _command_names -e; _files" : "";
}

/// Words of a positional. -f keeps fish from offering files, -F makes it; it refuses both at once.
std::string fish_positional(const OptionInfo& option) {
  if (option.type == "FILE") return " -F";
  if (option.type == "COMMAND") return " -F -a '(__fish_complete_command)'";
  return fmt::format(" -f -a '{}'", fmt::join(option.choices, " "));
}

std::string zsh_values(const OptionInfo& option) {
  if (option.type == "FILE") {
    return "_files";
  }
  if (option.type == "DIR") {
    return "_files -/";
  }
  return option.choices.empty() ? ":"
                                : fmt::format("compadd -- {}", fmt::join(option.choices, " "));
}

std::string fish_values(const OptionInfo& option) {
  if (option.type.empty()) {
    return " -f";
  }
  if (option.type == "FILE") {
    return " -r -F";
  }
  if (option.type == "DIR") {
    return " -x -a '(__fish_complete_directories)'";
  }
  return option.choices.empty() ? " -x"
                                : fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
}

}  // namespace

std::string bash_completion(const CommandInfo& root) {
  std::string values;
  std::string words;
  for (const CommandInfo* command : flattened(root)) {
    for (const OptionInfo& option : command->options) {
      if (takes_value(option)) {
        values += fmt::format("    {})\n      {}\n      return ;;\n",
                              option_patterns(*command, option), bash_values(option));
      }
    }
    words += fmt::format("    {}) words='{}'{} ;;\n", quoted(command->path),
                         fmt::join(words_of(*command), " "), bash_positional(*command));
  }
  return fmt::format(R"(# Completion of harpoon for bash; written by `harpoon completion bash`.
_harpoon() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}}
  local at=harpoon words='' more='' i
  for ((i = 1; i < COMP_CWORD; i++)); do
    case "$at ${{COMP_WORDS[i]}}" in
      {}) at="$at ${{COMP_WORDS[i]}}" ;;
    esac
  done
  case "$at $before" in
{}  esac
  case "$at" in
{}  esac
  COMPREPLY=($(compgen -W "$words" -- "$word"))
  if [[ -n $more && $word != -* ]]; then
    COMPREPLY+=($(compgen $more -- "$word"))
  fi
}}
complete -F _harpoon harpoon
)",
                     path_patterns(root), values, words);
}

std::string zsh_completion(const CommandInfo& root) {
  std::string values;
  std::string words;
  for (const CommandInfo* command : flattened(root)) {
    std::string entries;
    for (const CommandInfo& sub : command->subcommands) {
      entries += ' ';
      entries += described(sub.name, sub.help);
    }
    for (const OptionInfo& option : command->options) {
      const std::vector<std::string> names{option.names.back()};
      for (const std::string& name : option.is_positional ? option.choices : names) {
        entries += ' ';
        entries += described(name, option.help);
      }
      if (takes_value(option)) {
        values += fmt::format("    {}) {}; return ;;\n", option_patterns(*command, option),
                              zsh_values(option));
      }
    }
    words += fmt::format("    {}) entries=({}){} ;;\n", quoted(command->path), entries,
                         zsh_positional(*command));
  }
  return fmt::format(R"(#compdef harpoon
# Completion of harpoon for zsh; written by `harpoon completion zsh`.
_harpoon() {{
  local at=harpoon i
  local -a entries
  for ((i = 2; i < CURRENT; i++)); do
    case "$at $words[i]" in
      {}) at="$at $words[i]" ;;
    esac
  done
  case "$at $words[CURRENT-1]" in
{}  esac
  case "$at" in
{}  esac
  _describe 'harpoon' entries
}}
_harpoon "$@"
)",
                     path_patterns(root), values, words);
}

std::string fish_completion(const CommandInfo& root) {
  std::string paths;
  std::string lines;
  for (const CommandInfo* command : flattened(root)) {
    if (command != &root) {
      paths += ' ';
      paths += quoted(command->path);
    }
    const std::string here =
        fmt::format("complete -c harpoon -n '__harpoon_at \"{}\"'", command->path);
    for (const CommandInfo& sub : command->subcommands) {
      lines += fmt::format("{} -f -a {} -d {}\n", here, sub.name, quoted(sub.help));
    }
    for (const OptionInfo& option : command->options) {
      std::string names;
      if (option.is_positional) {
        lines += fmt::format("{}{} -d {}\n", here, fish_positional(option), quoted(option.help));
        continue;
      }
      for (const std::string& name : option.names) {
        const bool is_long = name.starts_with("--");
        names += fmt::format(" {} {}", is_long ? "-l" : "-s", name.substr(is_long ? 2 : 1));
      }
      lines += fmt::format("{}{}{} -d {}\n", here, names, fish_values(option), quoted(option.help));
    }
  }
  return fmt::format(R"(# Completion of harpoon for fish; written by `harpoon completion fish`.
function __harpoon_at
  set -l at harpoon
  for word in (commandline -opc)[2..-1]
    if contains -- "$at $word"{}
      set at "$at $word"
    end
  end
  test "$at" = "$argv[1]"
end
{})",
                     paths, lines);
}

}  // namespace harpoon::app
