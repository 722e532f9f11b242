#include "apps/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

namespace harpoon::app {

CLI::Option* add_choice(CLI::App& app, const std::string& flag, std::string& value,
                        const std::vector<std::string>& choices, const std::string& help) {
  const auto check = [choices](std::string& text) {
    const bool is_one = std::find(choices.begin(), choices.end(), text) != choices.end();
    return is_one ? std::string()
                  : fmt::format("'{}' is not one of {}", text, fmt::join(choices, ", "));
  };
  return app.add_option(flag, value, help)
      ->check(CLI::Validator(check, "", ""))
      ->type_name(fmt::format("{}", fmt::join(choices, "|")));
}

CLI::Validator whole_number(std::uint64_t low, std::uint64_t high) {
  const auto check = [low, high](std::string& text) {
    std::uint64_t number = 0;
    const char* end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, number);
    const bool is_good =
        parsed.ec == std::errc() && parsed.ptr == end && number >= low && number <= high;
    return is_good ? std::string()
                   : fmt::format("'{}' is not a whole number from {} to {}", text, low, high);
  };
  return CLI::Validator(check, "", "");
}

}  // namespace harpoon::app
