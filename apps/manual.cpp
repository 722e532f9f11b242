#include "apps/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>

namespace harpoon::app {
namespace {

std::string option_entry(const OptionInfo& option) {
  const std::string value =
      option.type.empty() ? "" : fmt::format(" \\fI{}\\fR", roff_escaped(option.type));
  const std::string usual = option.default_value.empty()
                                ? ""
                                : fmt::format(" Default: {}.", roff_escaped(option.default_value));
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}.{}\n",
                     roff_escaped(fmt::format("{}", fmt::join(option.names, ", "))), value,
                     roff_escaped(option.help), usual);
}

// Footers are laid out by hand; they are shown line by line.
std::string as_it_is(const std::string& text) {
  std::string out = ".PP\n.nf\n";
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    out += line.empty() ? ".sp\n" : roff_escaped(line) + "\n";
  }
  return out + ".fi\n";
}

std::string command_section(const CommandInfo& command) {
  std::string out =
      fmt::format(".SS {}\n{}.\n", roff_escaped(command.path), roff_escaped(command.help));
  for (const OptionInfo& option : command.options) {
    out += option_entry(option);
  }
  return out + (command.footer.empty() ? "" : as_it_is(command.footer));
}

}  // namespace

std::string roff_escaped(const std::string& text) {
  std::string out;
  bool at_line_start = true;
  for (const char c : text) {
    if (at_line_start && (c == '.' || c == '\'')) {
      out += "\\&";
    }
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
    at_line_start = c == '\n';
  }
  return out;
}

std::string manual_page(const CommandInfo& root, const std::string& version) {
  std::string page = fmt::format(".TH HARPOON 1 \"\" \"harpoon {}\" \"User Commands\"\n", version);
  page += fmt::format(".SH NAME\nharpoon \\- {}\n", roff_escaped(root.help));
  page += ".SH SYNOPSIS\n";
  for (const CommandInfo* command : flattened(root)) {
    if (command->subcommands.empty()) {
      page += fmt::format(".B {}\n[\\fIoptions\\fR]\n.br\n", roff_escaped(command->path));
    }
  }
  page += ".SH OPTIONS\n";
  for (const OptionInfo& option : root.options) {
    page += option_entry(option);
  }
  page += ".SH COMMANDS\n";
  for (const CommandInfo* command : flattened(root)) {
    if (command != &root) {
      page += command_section(*command);
    }
  }
  return page + ".SH NOTES\n" + as_it_is(root.footer);
}

}  // namespace harpoon::app
