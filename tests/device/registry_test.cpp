#include <gtest/gtest.h>

#include "harpoon/device.hpp"

namespace harpoon {
namespace {

TEST(Registry, ListsCpuFirstAndOpensWhatItLists) {
  const auto devices = list_devices();
  ASSERT_FALSE(devices.empty());
  EXPECT_EQ(devices[0].name, "cpu");
  for (const DeviceInfo& info : devices) {
    EXPECT_FALSE(info.description.empty()) << info.name;
    const auto device = open_device(info.name);
    EXPECT_EQ(device.ok(), info.available) << info.name;
    if (device) {
      EXPECT_EQ((*device)->name(), info.name);
    }
  }
}

TEST(Registry, AnUnknownNameIsAnErrorThatListsTheKnownOnes) {
  const auto device = open_device("abacus");
  ASSERT_FALSE(device);
  EXPECT_EQ(device.error().code, Errc::invalid_argument);
  EXPECT_NE(device.error().message.find("abacus"), std::string::npos);
  EXPECT_NE(device.error().message.find("cpu"), std::string::npos);
}

}  // namespace
}  // namespace harpoon
