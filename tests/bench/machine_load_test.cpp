#include "bench/machine_load.hpp"

#include <gtest/gtest.h>

#include "bench/json.hpp"

namespace harpoon::bench {
namespace {

TEST(MachineLoad, IsWhatTheKernelTells) {
  const LoadWatch watch;
  const MachineLoad load = watch.look();
  EXPECT_GE(load.before, 0);
  EXPECT_GE(load.after, 0);
  if (load.waiting) {
    EXPECT_GE(*load.waiting, 0);
    EXPECT_LE(*load.waiting, 1);
  }
}

TEST(MachineLoad, IsBusyWhereOthersWait) {
  EXPECT_TRUE((MachineLoad{0.1, 0.1, 0.5}.busy()));
  EXPECT_FALSE((MachineLoad{9, 9, 0.05}.busy()));
  EXPECT_TRUE((MachineLoad{3, 3, std::nullopt}.busy()));
  EXPECT_FALSE((MachineLoad{0.3, 1, std::nullopt}.busy()));
}

TEST(MachineLoad, IsSaidInWordsAndInJson) {
  EXPECT_EQ(
      describe_load({0.25, 1.5, 0.031}),
      "Load average 0.2 before, 1.5 after; some task waited for a processor during 3 % of the "
      "time.");
  EXPECT_EQ(describe_load({4, 5, std::nullopt}),
            "Load average 4.0 before, 5.0 after. The machine was busy with other things: run again "
            "when it is not.");
  EXPECT_EQ(describe_load({}), "The kernel tells no load average.");
  const Json json = load_json({0.25, -1, std::nullopt});
  EXPECT_EQ(json.at("before"), 0.25);
  EXPECT_TRUE(json.at("after").is_null());
  EXPECT_TRUE(json.at("waiting").is_null());
  EXPECT_EQ(json.at("busy"), false);
}

}  // namespace
}  // namespace harpoon::bench
