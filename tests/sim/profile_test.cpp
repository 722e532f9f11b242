#include "sim/profile.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace harpoon::sim {
namespace {

TEST(LinkProfile, HarpIsThePapersLink) {
  const auto harp = find_profile("harp");
  ASSERT_TRUE(harp.ok());
  EXPECT_EQ(harp->clock_mhz, 200);
  EXPECT_EQ(harp->gigabytes_per_s, 8);
  EXPECT_TRUE(harp->shared_bandwidth);
  EXPECT_EQ(harp->read_latency_ns, 355);
  EXPECT_NE(harp->description.find("assumed"), std::string_view::npos);
}

TEST(LinkProfile, F2AllowsThirtyTwoReads) {
  EXPECT_EQ(find_profile("f2")->lines_in_flight, 32u);
}

TEST(LinkProfile, NumbersCanBeReplaced) {
  const auto profile = parse_profile("harp,latency_ns=500,gbps=12.8,shared=0,in_flight=4");
  ASSERT_TRUE(profile.ok());
  EXPECT_EQ(profile->read_latency_ns, 500);
  EXPECT_EQ(profile->gigabytes_per_s, 12.8);
  EXPECT_FALSE(profile->shared_bandwidth);
  EXPECT_EQ(profile->lines_in_flight, 4u);
  EXPECT_EQ(profile->clock_mhz, 200);
}

TEST(LinkProfile, WhatIsWrongIsNamed) {
  EXPECT_NE(parse_profile("harpy").error().message.find("pcie3x16"), std::string::npos);
  for (const char* bad : {"harp,gbps", "harp,speed=1", "harp,=1", "harp,,", "harp,gbps = 1"}) {
    const auto profile = parse_profile(bad);
    ASSERT_FALSE(profile.ok()) << bad;
    EXPECT_EQ(profile.error().code, Errc::invalid_argument);
    EXPECT_NE(profile.error().message.find("in_flight"), std::string::npos)
        << profile.error().message;
  }
}

TEST(LinkProfile, EveryNumberHasARangeThatIsSaid) {
  const struct {
    const char* key;
    double low, high;
    bool is_whole;
  } settings[] = {{"clock_mhz", 1, 2000, false},
                  {"gbps", 0.1, 1000, false},
                  {"shared", 0, 1, true},
                  {"latency_ns", 0, 100000, false},
                  {"write_latency_ns", 0, 100000, false},
                  {"in_flight", 1, 64, true}};
  for (const auto& setting : settings) {
    const auto with = [&](const std::string& value) {
      return parse_profile("harp," + std::string(setting.key) + "=" + value);
    };
    EXPECT_TRUE(with(fmt::format("{}", setting.low)).ok()) << setting.key;
    EXPECT_TRUE(with(fmt::format("{}", setting.high)).ok()) << setting.key;
    std::vector<std::string> bad = {"nan",
                                    "inf",
                                    "-inf",
                                    "-1",
                                    "1e300",
                                    "9223372036854775808",
                                    "",
                                    "ten",
                                    "1y",
                                    " 1",
                                    "0x10",
                                    "-0.001",
                                    fmt::format("{}", setting.high * 1.001)};
    if (setting.is_whole) bad.push_back(fmt::format("{}", setting.low + 0.5));
    for (const std::string& value : bad) {
      const auto profile = with(value);
      ASSERT_FALSE(profile.ok()) << setting.key << " " << value;
      EXPECT_EQ(profile.error().code, Errc::invalid_argument);
      const std::string range = fmt::format("from {} to {}", setting.low, setting.high);
      EXPECT_NE(profile.error().message.find(range), std::string::npos) << profile.error().message;
    }
  }
}

TEST(LinkProfile, NumbersOfACallerHaveTheSameRanges) {
  LinkProfile profile = *find_profile("harp");
  EXPECT_FALSE(check_profile(profile).has_value());
  profile.read_latency_ns = std::nan("");
  EXPECT_TRUE(check_profile(profile).has_value());
  profile = *find_profile("f2");
  profile.lines_in_flight = 0;
  EXPECT_TRUE(check_profile(profile).has_value());
}

}  // namespace
}  // namespace harpoon::sim
