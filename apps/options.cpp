#include "apps/options.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "apps/printable.hpp"

namespace harpoon::app {
namespace {

/// The whole of `text` as a number.
template <class Number>
bool parse(const std::string& text, Number& number) {
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, number);
  return parsed.ec == std::errc() && parsed.ptr == end;
}

}  // namespace

CLI::Option* add_choice(CLI::App& app, const std::string& flag, std::string& value,
                        const std::vector<std::string>& choices, const std::string& help) {
  const auto check = [choices](std::string& text) {
    const bool is_one = std::find(choices.begin(), choices.end(), text) != choices.end();
    return is_one ? std::string()
                  : fmt::format("{} is not one of {}", in_quotes(text), fmt::join(choices, ", "));
  };
  return app.add_option(flag, value, help)
      ->check(CLI::Validator(check, "", ""))
      ->type_name(fmt::format("{}", fmt::join(choices, "|")));
}

CLI::Validator whole_number(std::uint64_t low, std::uint64_t high) {
  const auto check = [low, high](std::string& text) {
    std::uint64_t number = 0;
    if (!parse(text, number) || number < low || number > high) {
      return fmt::format("{} is not a whole number from {} to {}", in_quotes(text), low, high);
    }
    text = fmt::format("{}", number);  // a leading zero would make it octal
    return std::string();
  };
  return CLI::Validator(check, "", "");
}

CLI::Validator real_number(double low, double high) {
  const auto check = [low, high](std::string& text) {
    double number = 0;
    const bool is_good =
        parse(text, number) && std::isfinite(number) && number >= low && number <= high;
    return is_good ? std::string()
                   : fmt::format("{} is not a number from {} to {}", in_quotes(text), low, high);
  };
  return CLI::Validator(check, "", "");
}

CLI::Option* add_real(CLI::App& app, const std::string& flag, double& value, double low,
                      double high, const char* type, const std::string& help) {
  return app.add_option(flag, value, fmt::format("{} ({} to {})", help, low, high))
      ->check(real_number(low, high))
      ->type_name(type)
      ->capture_default_str();
}

CLI::Option* add_seed(CLI::App& app, std::uint64_t& value, const std::string& help) {
  return app.add_option("--seed", value, help)
      ->transform(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      ->type_name("N")
      ->capture_default_str();
}

CLI::Option* add_name(CLI::App& app, const std::string& flag, std::string& value,
                      const std::string& type, const std::string& help) {
  const auto check = [](std::string& text) { return std::string(text.empty() ? "is empty" : ""); };
  return app.add_option(flag, value, help)
      ->check(CLI::Validator(check, "", ""))
      ->type_name(type)
      ->capture_default_str();
}

}  // namespace harpoon::app
