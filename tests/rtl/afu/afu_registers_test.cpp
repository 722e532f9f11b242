// The register map as a driver sees it, and the moments at which a driver may write a register.

#include "device/afu/rig.hpp"
#include "device/afu/transaction.hpp"

namespace harpoon::afu_test {
namespace {

namespace c = afu::contract;

struct Driver {
  explicit Driver(const sim::LinkNoise& noise = {}, std::uint64_t pages = 4)
      : link(take(sim::SimulatedLink::create({profile("harp"), noise}))) {
    afu::Timeouts timeouts;
    timeouts.transaction_us = 300;
    service = take(afu::Service::open(*link, timeouts, {}));
    workspace.emplace(
        take(afu::Workspace::allocate(*link, pages * c::kPageBytes, std::uint64_t{1} << 40)));
  }
  afu::Transaction transaction(const afu::Layout& layout) {
    return {*service, 0, *workspace, layout, log};
  }
  afu::Line line(std::uint64_t at) const { return afu::load_line(workspace->at(at)); }

  std::unique_ptr<sim::SimulatedLink> link;
  std::unique_ptr<afu::Service> service;
  std::optional<afu::Workspace> workspace;
  afu::Log log;
};

void expect_right(std::span<const std::byte> results, const std::vector<SpherePair>& pairs) {
  std::vector<Contact> contacts(pairs.size());
  ASSERT_GE(results.size(), contacts.size() * sizeof(Contact));
  std::memcpy(contacts.data(), results.data(), contacts.size() * sizeof(Contact));
  EXPECT_EQ(first_wrong(pairs, contacts), -1);
}

TEST(AfuRegisters, SayWhatTheAfuIs) {
  const Driver driver;
  sim::SimulatedLink& link = *driver.link;
  EXPECT_EQ(link.read_register(c::kRegAfuId0), static_cast<std::uint32_t>(c::kAfuIdLow));
  EXPECT_EQ(link.read_register(c::kRegAfuId1), static_cast<std::uint32_t>(c::kAfuIdLow >> 32));
  EXPECT_EQ(link.read_register(c::kRegAfuId2), static_cast<std::uint32_t>(c::kAfuIdHigh));
  EXPECT_EQ(link.read_register(c::kRegAfuId3), static_cast<std::uint32_t>(c::kAfuIdHigh >> 32));
  const std::uint32_t config = link.read_register(c::kRegConfig);
  EXPECT_EQ(config & 0xff, driver.service->identity().scpus);
  EXPECT_EQ(config >> 8 & 0xff, 64u);
  EXPECT_EQ(config >> 16 & 0xff, driver.service->identity().lanes);
  EXPECT_EQ(link.read_register(c::kRegTableSpheres), 16384u);
}

TEST(AfuRegisters, KeepLegalSettingsOnly) {
  const Driver driver;
  sim::SimulatedLink& link = *driver.link;
  for (const auto& [written, kept] :
       {std::pair{5u, 5u}, {64u, 64u}, {65u, 64u}, {1u, 1u}, {0u, 64u}, {~0u, 64u}}) {
    link.write_register(c::kRegInFlight, written);
    EXPECT_EQ(link.read_register(c::kRegInFlight), kept) << written;
  }
  for (const std::uint32_t mode : {1u, 0u}) {
    link.write_register(c::kRegPucMode, mode);
    EXPECT_EQ(link.read_register(c::kRegPucMode), mode);
  }
  link.write_register(0x0ffc, 0xffffffff);  // nothing is there
  EXPECT_EQ(link.read_register(0x0ffc), 0u);
  link.write_register(c::kRegConfig, 0);  // read-only
  EXPECT_NE(link.read_register(c::kRegConfig), 0u);
  EXPECT_EQ(link.read_register(c::kRegPucMode), 0u);
}

TEST(AfuRegisters, ApCtrlStartsAndTellsTheEndOnce) {
  Driver driver;
  const auto pairs = pairs_with_hits(1, 30, 0.5);
  afu::Transaction transaction = driver.transaction({c::Format::direct, 30, 0, false, 30});
  std::memcpy(transaction.source(), pairs.data(), pairs.size() * sizeof(SpherePair));
  transaction.start(1);
  // What was enabled by CH_CTRL is stopped before it did anything, and started as XRT would.
  driver.link->write_register(c::kRegSpl2ChCtrl, c::kChReset);
  driver.link->advance(400);
  EXPECT_EQ(driver.link->read_register(c::kRegApCtrl) & c::kApIdle, c::kApIdle);
  driver.link->write_register(c::kRegApCtrl, c::kApStart);
  EXPECT_EQ(driver.link->read_register(c::kRegApCtrl) & c::kApDone, 0u);
  const auto counters = transaction.finish();
  ASSERT_TRUE(counters.ok()) << counters.error().message;
  const auto results = transaction.results();
  ASSERT_TRUE(results.ok());
  expect_right(*results, pairs);
  driver.link->advance(200);
  EXPECT_EQ(driver.link->read_register(c::kRegApCtrl) & c::kApDone, c::kApDone);
  EXPECT_EQ(driver.link->read_register(c::kRegApCtrl) & c::kApDone, 0u) << "cleared by the read";
}

TEST(AfuControlLine, IsPolledUntilItsStartByte) {
  Driver driver;
  const auto pairs = pairs_with_hits(2, 12, 0.5);
  afu::Transaction transaction = driver.transaction({c::Format::direct, 12, 0, false, 12});
  std::memcpy(transaction.source(), pairs.data(), pairs.size() * sizeof(SpherePair));
  transaction.start(1);
  const afu::Line go = driver.line(c::vafu2_cntxt::kControlOffset);
  store_line(driver.workspace->at(c::vafu2_cntxt::kControlOffset), afu::Line{});
  driver.link->advance(1000);
  EXPECT_EQ(driver.line(c::vafu2_cntxt::kStatusOffset).words[0], 0u) << "started by itself";
  store_line(driver.workspace->at(c::vafu2_cntxt::kControlOffset), go);
  ASSERT_TRUE(transaction.finish().ok());
  const auto results = transaction.results();
  ASSERT_TRUE(results.ok());
  expect_right(*results, pairs);
}

// The table outlives a transaction; the control line's reset byte forgets it.
TEST(AfuControlLine, ForgetsTheTableWhenItsResetByteSaysSo) {
  for (const bool forget : {false, true}) {
    Driver driver;
    afu::Transaction first = driver.transaction({c::Format::indexed_hits, 16, 8, true, 16});
    first.start(1);
    ASSERT_TRUE(first.finish().ok());
    ASSERT_TRUE(first.results().ok());
    first.release();
    afu::Transaction second = driver.transaction({c::Format::indexed_hits, 16, 0, false, 16});
    second.start(2);
    const afu::Line go = driver.line(c::vafu2_cntxt::kControlOffset);
    afu::Line wait = go;
    wait.put(c::control::kStart, 0);
    if (forget) wait.put(c::control::kReset, c::control::kGo);
    wait.seal();
    store_line(driver.workspace->at(c::vafu2_cntxt::kControlOffset), wait);
    driver.link->advance(1000);
    store_line(driver.workspace->at(c::vafu2_cntxt::kControlOffset), go);
    const auto counters = second.finish();
    EXPECT_EQ(counters.ok(), !forget);
    if (forget) {
      EXPECT_NE(counters.error().message.find(afu::describe(c::AfuError::index_out_of_range)),
                std::string::npos)
          << counters.error().message;
    }
  }
}

// SPL2 has its own line to write whenever SPL_DSM_BASE is written: while the page table is loaded,
// and while results are being written over a slow link.
TEST(AfuRegisters, TheDsmBaseMayBeWrittenAtAnyTime) {
  const auto pairs = pairs_with_hits(3, 200, 1);
  for (std::uint64_t delay = 0; delay < 1800; delay += 31) {
    Driver driver({delay, 3, delay % 2 == 0 ? 60u : 0u}, 300);
    afu::Layout layout{c::Format::direct, 200, 0, false, 200};
    layout.spheres = 299 * c::kPageBytes / c::kSphereBytes;  // many pages, of which few are read
    afu::Transaction transaction = driver.transaction(layout);
    std::memcpy(transaction.source(), pairs.data(), pairs.size() * sizeof(SpherePair));
    transaction.start(1);
    driver.link->advance(delay + 1);
    const afu::SharedMemory dsm = take(driver.link->allocate(c::kPageBytes));
    for (int again = 0; again < 3; ++again) {
      const std::uint64_t address = dsm.page_addresses.front();
      driver.link->write_register(c::kRegSplDsmBase + 4, static_cast<std::uint32_t>(address >> 32));
      driver.link->write_register(c::kRegSplDsmBase, static_cast<std::uint32_t>(address));
    }
    const auto counters = transaction.finish();
    ASSERT_TRUE(counters.ok()) << "delay " << delay << ": " << counters.error().message;
    const auto results = transaction.results();
    ASSERT_TRUE(results.ok()) << "delay " << delay;
    expect_right(*results, pairs);
    driver.link->advance(400);
    const afu::Line id = afu::load_line(dsm.data + c::kSplDsmIdLine * c::kLineBytes);
    EXPECT_EQ(id.words[0], c::kSplId);
    EXPECT_TRUE(id.check_matches());
    driver.link->release(dsm);
    EXPECT_EQ(driver.link->model().breach(), "");
  }
}

}  // namespace
}  // namespace harpoon::afu_test
