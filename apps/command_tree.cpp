#include "apps/command_tree.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <sstream>

namespace harpoon::app {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    parts.push_back(part);
  }
  return parts;
}

OptionInfo describe_option(const CLI::Option& option) {
  OptionInfo info;
  for (const std::string& name : option.get_snames()) {
    info.names.push_back(fmt::format("-{}", name));
  }
  for (const std::string& name : option.get_lnames()) {
    info.names.push_back(fmt::format("--{}", name));
  }
  info.is_positional = info.names.empty();
  if (info.is_positional) {
    info.names.push_back(option.get_name(true));
  }
  info.help = option.get_description();
  if (option.get_items_expected_max() > 0) {
    info.type = option.get_type_name();
    info.default_value = option.get_default_str();
  }
  if (info.type.find('|') != std::string::npos) {
    info.choices = split(info.type, '|');
  }
  return info;
}

CommandInfo describe(const CLI::App& app, const std::string& parent) {
  CommandInfo info;
  info.name = app.get_name();
  info.path = parent.empty() ? info.name : parent + " " + info.name;
  info.help = app.get_description();
  info.footer = app.get_footer();
  for (const CLI::Option* option : app.get_options()) {
    info.options.push_back(describe_option(*option));
  }
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    info.subcommands.push_back(describe(*sub, info.path));
  }
  return info;
}

void append(const CommandInfo& info, std::vector<const CommandInfo*>& all) {
  all.push_back(&info);
  for (const CommandInfo& sub : info.subcommands) {
    append(sub, all);
  }
}

}  // namespace

CommandInfo describe_command(const CLI::App& root) {
  return describe(root, "");
}

std::vector<const CommandInfo*> flattened(const CommandInfo& root) {
  std::vector<const CommandInfo*> all;
  append(root, all);
  return all;
}

}  // namespace harpoon::app
