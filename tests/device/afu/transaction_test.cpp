// The seven steps against the simulated AFU, and every way in which the AFU refuses or faults.

#include "device/afu/transaction.hpp"

#include "device/afu/rig.hpp"

namespace harpoon::afu {
namespace {

using afu_test::profile;
namespace c = contract;

struct Bench {
  Bench() : link(afu_test::take(sim::SimulatedLink::create({profile("harp")}))) {
    Timeouts timeouts;
    timeouts.transaction_us = 30;
    service = afu_test::take(Service::open(*link, timeouts, {}));
    workspace.emplace(afu_test::take(Workspace::allocate(*link, 4 * c::kPageBytes, 1ull << 40)));
  }
  Transaction transaction(const Layout& layout) {
    return Transaction(*service, 0, *workspace, layout, log);
  }
  void change(std::uint64_t at, const c::Field& field, std::uint64_t value) {
    Line line = load_line(workspace->at(at));
    line.put(field, value);
    line.seal();
    store_line(workspace->at(at), line);
  }

  std::unique_ptr<sim::SimulatedLink> link;
  std::unique_ptr<Service> service;
  std::optional<Workspace> workspace;
  std::vector<std::string> lines;
  Log log = [this](LogLevel, std::string_view line) { lines.emplace_back(line); };
};

void fill(const Transaction& transaction, const std::vector<SpherePair>& pairs) {
  std::memcpy(transaction.source(), pairs.data(), pairs.size() * sizeof(SpherePair));
}

TEST(Transaction, TakesTheSevenStepsInOrder) {
  Bench bench;
  const auto pairs = afu_test::pairs_with_hits(1, 20, 0.5);
  Transaction transaction = bench.transaction({c::Format::direct, 20, 0, false, 20});
  fill(transaction, pairs);
  transaction.start(7);
  ASSERT_TRUE(transaction.finish().ok());
  const auto results = transaction.results();
  ASSERT_TRUE(results.ok());
  transaction.release();
  ASSERT_EQ(bench.lines.size(), 7u);
  for (int step = 1; step <= 7; ++step) {
    const std::string& line = bench.lines[static_cast<std::size_t>(step - 1)];
    EXPECT_NE(line.find("step " + std::to_string(step)), std::string::npos) << line;
  }
  EXPECT_TRUE(std::is_sorted(transaction.steps().begin(), transaction.steps().end()));
  std::vector<Contact> contacts(20);
  std::memcpy(contacts.data(), results->data(), 20 * sizeof(Contact));
  EXPECT_EQ(afu_test::first_wrong(pairs, contacts), -1);
}

TEST(Transaction, StatusComesAfterResultsAndCounters) {
  Bench bench;
  const auto pairs = afu_test::pairs_with_hits(2, 100, 1);
  Transaction transaction = bench.transaction({c::Format::direct, 100, 0, false, 100});
  fill(transaction, pairs);
  transaction.start(3);
  while (load_line(bench.workspace->at(c::vafu2_cntxt::kStatusOffset)).words[0] == 0)
    bench.link->advance(1);
  // Everything is in memory at the very cycle in which Status becomes visible.
  const Line performance = bench.service->afu_dsm(c::kDsmPerformanceLine);
  EXPECT_EQ(performance.get32(c::dsm_performance::kSequence), 3u);
  EXPECT_TRUE(performance.check_matches());
  EXPECT_EQ(performance.get32(c::dsm_performance::kLinesWritten), 50u);
  ASSERT_TRUE(transaction.finish().ok());
  EXPECT_TRUE(transaction.results().ok());
}

TEST(Transaction, CountsWhatItMoved) {
  Bench bench;
  const auto pairs = afu_test::pairs_with_hits(3, 101, 0.3);
  Transaction transaction = bench.transaction({c::Format::direct_hits, 101, 0, false, 101});
  fill(transaction, pairs);
  transaction.start(1);
  const auto counters = transaction.finish();
  ASSERT_TRUE(counters.ok());
  std::uint64_t hits = 0;
  for (const SpherePair& pair : pairs) hits += collide(pair).hit() ? 1 : 0;
  EXPECT_EQ(counters->hits, hits);
  EXPECT_EQ(counters->lines_read, 51u);
  EXPECT_EQ(counters->lines_written, (hits + 1) / 2);
  EXPECT_EQ(counters->scpu_pairs, 101u);
}

// Refusals: the AFU ends the transaction in good order and names the error in Status.
struct Refusal {
  const char* name;
  c::AfuError error;
  void (*spoil)(Bench&);
};

class TransactionRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(TransactionRefusal, IsReportedInStatus) {
  Bench bench;
  Transaction transaction = bench.transaction({c::Format::indexed_hits, 16, 4, true, 16});
  transaction.start(9);
  GetParam().spoil(bench);
  const auto counters = transaction.finish();
  ASSERT_FALSE(counters.ok());
  EXPECT_EQ(counters.error().code, Errc::device_fault);
  EXPECT_NE(counters.error().message.find(describe(GetParam().error)), std::string::npos)
      << counters.error().message;
  EXPECT_EQ(bench.link->read_register(c::kRegAfuError),
            static_cast<std::uint32_t>(GetParam().error));
}

constexpr std::uint64_t kControlAt = c::vafu2_cntxt::kControlOffset;

INSTANTIATE_TEST_SUITE_P(
    Afu, TransactionRefusal,
    testing::Values(Refusal{"context", c::AfuError::bad_context,
                            [](Bench& b) { *b.workspace->at(12) ^= std::byte{1}; }},
                    Refusal{"control", c::AfuError::bad_control,
                            [](Bench& b) { *b.workspace->at(kControlAt + 5) ^= std::byte{1}; }},
                    Refusal{"format", c::AfuError::bad_format,
                            [](Bench& b) {
                              b.change(kControlAt, c::control::kFormat, c::kFormatCount);
                            }},
                    Refusal{"count", c::AfuError::source_too_short,
                            [](Bench& b) { b.change(kControlAt, c::control::kPairCount, 17); }},
                    Refusal{"spheres", c::AfuError::too_many_spheres,
                            [](Bench& b) { b.change(0, c::vafu2_cntxt::kSphereCount, 16385); }},
                    Refusal{"index", c::AfuError::index_out_of_range,
                            [](Bench& b) {
                              b.change(0, c::vafu2_cntxt::kSphereCount, 3);
                              // The indices are in Src, after the context's page and one line of
                              // spheres.
                              *b.workspace->at(4096 + 64 + 20) = std::byte{3};
                            }}),
    [](const auto& refusal) { return refusal.param.name; });

// Faults: SPL2 stops the device and reports in its DSM.
TEST(TransactionFault, AnAddressOutsideTheWorkspaceIsAViolation) {
  Bench bench;
  Transaction transaction = bench.transaction({c::Format::direct, 20, 0, false, 20});
  transaction.start(1);
  const std::uint64_t beyond = bench.workspace->address() + c::kPageBytes;  // one page is mapped
  bench.change(0, c::vafu2_cntxt::kSource, beyond);
  const auto counters = transaction.finish();
  ASSERT_FALSE(counters.ok());
  EXPECT_EQ(counters.error().code, Errc::device_fault);
  EXPECT_NE(
      counters.error().message.find(describe_fault(
          static_cast<std::uint32_t>(c::Spl2Fault::access_violation), c::kRequestRead, beyond)),
      std::string::npos)
      << counters.error().message;
  EXPECT_EQ(bench.link->model().counters().stray_reads, 0u);
}

TEST(TransactionFault, AWriteOutsideTheWorkspaceNeverReachesTheBus) {
  Bench bench;
  Transaction transaction = bench.transaction({c::Format::direct, 20, 0, false, 20});
  transaction.start(1);
  bench.change(0, c::vafu2_cntxt::kDest, bench.workspace->address() - c::kPageBytes);
  const auto counters = transaction.finish();
  ASSERT_FALSE(counters.ok());
  EXPECT_EQ(counters.error().code, Errc::device_fault);
  EXPECT_NE(counters.error().message.find("on a write"), std::string::npos);
  EXPECT_EQ(bench.link->model().counters().stray_writes, 0u);
}

TEST(TransactionFault, IsTerminalUntilReset) {
  Bench bench;
  bench.link->model().arm({sim::FaultKind::error_read, 3, 0});
  Transaction transaction = bench.transaction({c::Format::direct, 20, 0, false, 20});
  transaction.start(1);
  const auto counters = transaction.finish();
  ASSERT_FALSE(counters.ok());
  EXPECT_NE(counters.error().message.find("error response"), std::string::npos);
  const std::uint64_t reads = bench.link->model().counters().lines_read;
  bench.link->advance(500);
  bench.link->write_register(c::kRegSpl2ChCtrl, c::kChEnable);
  bench.link->advance(500);
  EXPECT_EQ(bench.link->model().counters().lines_read, reads) << "a faulted SPL2 went on";
  EXPECT_EQ(bench.link->read_register(c::kRegSpl2Fault) & 1, 1u);
  // CH_CTRL reset ends it, and the next transaction is exact.
  bench.link->write_register(c::kRegSpl2ChCtrl, c::kChReset);
  bench.link->advance(500);
  EXPECT_EQ(bench.link->read_register(c::kRegSpl2Fault) & 1, 0u);
}

TEST(TransactionFault, AResetInMidTransactionDrainsTheBus) {
  Bench bench;
  const auto pairs = afu_test::pairs_with_hits(5, 200, 1);
  Transaction first = bench.transaction({c::Format::direct, 200, 0, false, 200});
  fill(first, pairs);
  first.start(1);
  bench.link->advance(400);
  EXPECT_NE(bench.link->read_register(c::kRegState) & 0xffff00, 0u) << "nothing is outstanding";
  bench.link->write_register(c::kRegSpl2ChCtrl, c::kChReset);
  // The second transaction is enabled while the first one's responses still arrive.
  Transaction second = bench.transaction({c::Format::direct, 200, 0, false, 200});
  fill(second, pairs);
  second.start(2);
  ASSERT_TRUE(second.finish().ok());
  const auto results = second.results();
  ASSERT_TRUE(results.ok());
  std::vector<Contact> contacts(200);
  std::memcpy(contacts.data(), results->data(), 200 * sizeof(Contact));
  EXPECT_EQ(afu_test::first_wrong(pairs, contacts), -1);
  EXPECT_EQ(bench.link->model().breach(), "");
}

TEST(TransactionFault, ACorruptContextIsRefused) {
  Bench bench;
  Transaction transaction = bench.transaction({c::Format::direct, 2, 0, false, 2});
  bench.link->model().arm({sim::FaultKind::corrupt_read, 0, 0});
  transaction.start(1);
  const auto counters = transaction.finish();
  ASSERT_FALSE(counters.ok());
  EXPECT_EQ(counters.error().code, Errc::device_fault);
  EXPECT_NE(counters.error().message.find("context or page table"), std::string::npos);
}

}  // namespace
}  // namespace harpoon::afu
