#include "sim/profile.hpp"

#include <gtest/gtest.h>

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
  for (const char* bad : {"harp,gbps", "harp,gbps=x", "harp,gbps=0", "harp,speed=1",
                          "harp,in_flight=65", "harp,gbps=1y", "harp,latency_ns=-1"}) {
    const auto profile = parse_profile(bad);
    ASSERT_FALSE(profile.ok()) << bad;
    EXPECT_EQ(profile.error().code, Errc::invalid_argument);
  }
}

}  // namespace
}  // namespace harpoon::sim
