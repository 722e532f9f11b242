// Opening the AFU: it identifies itself in time, or a typed error says what was seen.

#include "device/afu/runtime.hpp"

#include "device/afu/rig.hpp"

namespace harpoon::afu {
namespace {

using afu_test::profile;

std::unique_ptr<sim::SimulatedLink> make_link() {
  return afu_test::take(sim::SimulatedLink::create({profile("harp")}));
}

TEST(Service, ReadsTheIdentityFromTheDsm) {
  const auto link = make_link();
  const auto service = Service::open(*link, {}, {});
  ASSERT_TRUE(service.ok());
  const AfuIdentity& id = (*service)->identity();
  EXPECT_EQ(id.id_low, contract::kAfuIdLow);
  EXPECT_EQ(id.id_high, contract::kAfuIdHigh);
  EXPECT_EQ(id.scpus, 10u);
  EXPECT_EQ(id.lines_in_flight, 64u);
  EXPECT_GE(id.table_spheres, 16384u);
  EXPECT_EQ(link->read_register(contract::kRegAfuId0),
            static_cast<std::uint32_t>(contract::kAfuIdLow));
  EXPECT_EQ(link->read_register(contract::kRegApCtrl), contract::kApIdle);
}

TEST(Service, RefusesAnotherAfu) {
  const auto link = make_link();
  link->model().arm({sim::FaultKind::wrong_afu_id, 0, 0});
  const auto service = Service::open(*link, {}, {});
  ASSERT_FALSE(service.ok());
  EXPECT_EQ(service.error().code, Errc::device_fault);
  EXPECT_NE(service.error().message.find("another AFU"), std::string::npos);
}

TEST(Service, GivesUpOnASilentDevice) {
  const auto link = make_link();
  link->reset();
  link->model().arm({sim::FaultKind::drop_write, 0, 0});
  const std::uint64_t begin = link->now();
  Timeouts timeouts;
  timeouts.identify_us = 10;
  const auto service = Service::open(*link, timeouts, {});
  ASSERT_FALSE(service.ok());
  EXPECT_EQ(service.error().code, Errc::device_timeout);
  EXPECT_LT(link->now() - begin, 2000u + 6000u) << "10 us are 2000 cycles at 200 MHz";
}

TEST(Service, RefusesALimitThatIsNone) {
  const double bad[] = {-1, -1e-9, std::nan(""), std::numeric_limits<double>::infinity(), 1e300};
  for (const auto member :
       {&Timeouts::identify_us, &Timeouts::transaction_us, &Timeouts::per_pair_us}) {
    for (const double limit : bad) {
      const auto link = make_link();
      Timeouts timeouts;
      timeouts.*member = limit;
      const auto service = Service::open(*link, timeouts, {});
      ASSERT_FALSE(service.ok()) << limit;
      EXPECT_EQ(service.error().code, Errc::invalid_argument);
      EXPECT_NE(service.error().message.find("_us is"), std::string::npos);
    }
    Timeouts none;
    none.*member = 0;
    EXPECT_FALSE(check(none).has_value());
  }
}

TEST(Workspace, IsAtMostTwoGigabytes) {
  const auto link = make_link();
  const auto largest = Workspace::allocate(*link, contract::kMaxWorkspaceBytes, 1ull << 40);
  ASSERT_TRUE(largest.ok());
  EXPECT_EQ(largest->memory().page_addresses.size(), 1024u);
  const auto larger = Workspace::allocate(*link, contract::kMaxWorkspaceBytes + 1, 1ull << 40);
  ASSERT_FALSE(larger.ok());
  EXPECT_EQ(larger.error().code, Errc::invalid_argument);
  EXPECT_FALSE(Workspace::allocate(*link, 0, 1ull << 40).ok());
}

TEST(Workspace, IsScatteredInPhysicalMemory) {
  const auto link = make_link();
  const auto workspace = Workspace::allocate(*link, 64 * contract::kPageBytes, 1ull << 40);
  ASSERT_TRUE(workspace.ok());
  const std::vector<std::uint64_t>& pages = workspace->memory().page_addresses;
  int neighbours = 0;
  for (std::size_t i = 1; i < pages.size(); ++i)
    neighbours += pages[i] == pages[i - 1] + contract::kPageBytes ? 1 : 0;
  EXPECT_EQ(neighbours, 0) << "an AFU that does not translate could work by luck";
}

}  // namespace
}  // namespace harpoon::afu
