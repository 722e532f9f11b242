#include "ode/options.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace harpoon::ode {
namespace {

std::map<std::string, std::string>& variables() {
  static std::map<std::string, std::string> all;
  return all;
}

const char* variable(const char* name) {
  const auto found = variables().find(name);
  return found == variables().end() ? nullptr : found->second.c_str();
}

Result<Options> read(std::map<std::string, std::string> all) {
  variables() = std::move(all);
  return read_options(&variable);
}

TEST(Options, WithoutVariablesAreExactAndQuiet) {
  const Result<Options> options = read({});
  ASSERT_TRUE(options.ok());
  EXPECT_EQ(options->policy, Policy::compat);
  EXPECT_FALSE(options->verify);
  EXPECT_FALSE(options->statistics);
  EXPECT_FALSE(options->single_precision_contacts);
  EXPECT_EQ(options->device, "cpu");
}

TEST(Options, EveryVariableIsRead) {
  const Result<Options> options = read({{"HARPOON_ODE", "fixed"},
                                        {"HARPOON_VERIFY", "1"},
                                        {"HARPOON_STATS", "1"},
                                        {"HARPOON_DEVICE", "afu"},
                                        {"HARPOON_PRECISION", "f32"},
                                        {"HARPOON_MIN_GEOMS", "7"}});
  ASSERT_TRUE(options.ok());
  EXPECT_EQ(options->policy, Policy::fixed);
  EXPECT_TRUE(options->verify);
  EXPECT_TRUE(options->statistics);
  EXPECT_TRUE(options->single_precision_contacts);
  EXPECT_EQ(options->device, "afu");
  EXPECT_EQ(options->min_geoms_simple, 7);
  EXPECT_EQ(options->min_geoms_scan, 7);
  EXPECT_EQ(read({{"HARPOON_ODE", "strict"}})->policy, Policy::strict);
}

TEST(Options, WrongValuesAreErrorsThatNameTheRightOnes) {
  const std::map<std::string, std::string> wrong = {{"HARPOON_ODE", "fast"},
                                                    {"HARPOON_VERIFY", "yes"},
                                                    {"HARPOON_STATS", "2"},
                                                    {"HARPOON_PRECISION", "f16"},
                                                    {"HARPOON_MIN_GEOMS", "-1"}};
  for (const auto& [name, value] : wrong) {
    const Result<Options> options = read({{name, value}});
    ASSERT_FALSE(options.ok()) << name;
    EXPECT_EQ(options.error().code, Errc::invalid_argument);
    EXPECT_NE(options.error().message.find(name + "=" + value), std::string::npos);
    EXPECT_NE(options.error().message.find("use "), std::string::npos);
  }
}

}  // namespace
}  // namespace harpoon::ode
