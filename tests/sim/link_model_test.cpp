// The link model alone, driven by a scripted master: latency, bandwidth, order, faults, judgement.

#include "sim/link_model.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

namespace harpoon::sim {
namespace {

struct Master {
  explicit Master(const char* profile, LinkNoise noise = {})
      : model(*parse_profile(profile), noise, memory), buffer(*memory.allocate(1 << 21)) {}

  /// One cycle; issues the next read and the next write as soon as the link takes them.
  void cycle() {
    AxiRequest request{};
    request.single_beats = true;
    request.w_data = data.data();
    request.ar_valid = reads_issued < reads_wanted;
    request.ar_id = reads_issued % 64;
    request.ar_address = address(reads_issued);
    request.aw_valid = writes_addressed < writes_wanted;
    request.aw_id = writes_addressed % 64;
    request.aw_address = address(writes_addressed);
    request.w_valid = writes_sent < writes_wanted;
    data[0] = 1000 + writes_sent;
    const AxiResponse response = model.drive();
    if (response.r_valid) {
      read_ids.push_back(response.r_id);
      read_times.push_back(now);
      last_response = response;
    }
    if (response.b_valid) ack_times.push_back(now);
    model.sample(request);
    if (request.ar_valid && response.ar_ready) ++reads_issued;
    if (request.aw_valid && response.aw_ready) ++writes_addressed;
    if (request.w_valid && response.w_ready) ++writes_sent;
    ++now;
  }
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) cycle();
  }
  [[nodiscard]] std::uint64_t address(std::uint32_t line) const {
    return buffer.page_addresses.front() + std::uint64_t{line} * 64;
  }

  PhysicalMemory memory{1};
  LinkModel model;
  afu::SharedMemory buffer;
  Line data{};
  AxiResponse last_response;
  std::uint32_t reads_wanted = 0, writes_wanted = 0, reads_issued = 0;
  std::uint32_t writes_addressed = 0, writes_sent = 0;
  std::vector<std::uint32_t> read_ids;
  std::vector<int> read_times, ack_times;
  int now = 0;
};

TEST(LinkModel, AnswersALoneReadAfterTheLatency) {
  Master master("harp");
  const std::uint32_t word = 0xfeed;
  std::memcpy(master.buffer.data, &word, 4);
  master.reads_wanted = 1;
  master.run(100);
  ASSERT_EQ(master.read_times.size(), 1u);
  EXPECT_EQ(master.read_times[0], 71);  // 355 ns at 200 MHz
  EXPECT_EQ(master.last_response.r_data[0], word);
}

TEST(LinkModel, SharesTheBandwidthOrGivesItToEachDirection) {
  for (const auto& [profile, per_read] :
       {std::pair{"harp", 3.2}, std::pair{"harp,shared=0", 1.6}}) {
    Master master(profile);
    master.reads_wanted = master.writes_wanted = 100000;
    master.run(20000);
    const double reads = static_cast<double>(master.model.counters().lines_read);
    const double writes = static_cast<double>(master.model.counters().lines_written);
    EXPECT_NEAR(20000 / reads, per_read, 0.05) << profile;
    EXPECT_NEAR(20000 / writes, per_read, 0.05) << profile;
  }
}

TEST(LinkModel, KeepsToTheOutstandingLimit) {
  Master master("harp,in_flight=4");
  master.reads_wanted = 1000;
  master.run(5000);
  EXPECT_EQ(master.model.counters().most_reads, 4u);
  // Little's law: 4 lines in 71 cycles.
  EXPECT_NEAR(static_cast<double>(master.model.counters().lines_read), 5000.0 * 4 / 71, 20);
}

TEST(LinkModel, AnswersInAnyOrderWhenAsked) {
  Master calm("harp"), wild("harp", {5, 100, 0});
  calm.reads_wanted = wild.reads_wanted = 60;
  calm.run(600);
  wild.run(600);
  EXPECT_TRUE(std::is_sorted(calm.read_ids.begin(), calm.read_ids.end()));
  EXPECT_FALSE(std::is_sorted(wild.read_ids.begin(), wild.read_ids.end()));
  EXPECT_EQ(std::set<std::uint32_t>(wild.read_ids.begin(), wild.read_ids.end()).size(), 60u);
}

TEST(LinkModel, WithholdsReady) {
  Master master("harp", {5, 0, 90});
  master.reads_wanted = 60;
  master.run(200);
  EXPECT_LT(master.reads_issued, 40u);
}

TEST(LinkModel, AcknowledgesAWriteAfterItIsVisible) {
  Master master("harp");
  master.writes_wanted = 1;
  const auto written = [&] {
    std::uint32_t word = 0;
    std::memcpy(&word, master.buffer.data, 4);
    return word == 1000;
  };
  while (!written() && master.now < 200) master.cycle();
  const int visible = master.now;
  master.run(100);
  ASSERT_EQ(master.ack_times.size(), 1u);
  EXPECT_LT(visible, master.ack_times[0]);
}

TEST(LinkModel, AnswersWhereNothingIsMappedWithAnError) {
  Master master("harp");
  master.buffer.page_addresses.front() ^= std::uint64_t{1} << 40;
  master.reads_wanted = 1;
  master.run(100);
  EXPECT_EQ(master.last_response.r_resp, 3u);
  EXPECT_EQ(master.model.counters().stray_reads, 1u);
}

struct Script {
  FaultKind kind;
  std::size_t reads, acks;
};

TEST(LinkModel, InjectsReadAndWriteFaults) {
  for (const Script& script :
       {Script{FaultKind::none, 5, 5}, Script{FaultKind::drop_read, 4, 5},
        Script{FaultKind::duplicate_read, 6, 5}, Script{FaultKind::drop_ack, 5, 4},
        Script{FaultKind::duplicate_ack, 5, 6}, Script{FaultKind::drop_write, 5, 5},
        Script{FaultKind::hang, 0, 0}}) {
    Master master("harp");
    master.model.arm({script.kind, 2, 10});
    master.reads_wanted = master.writes_wanted = 5;
    master.run(400);
    EXPECT_EQ(master.read_ids.size(), script.reads) << to_string(script.kind);
    EXPECT_EQ(master.ack_times.size(), script.acks) << to_string(script.kind);
    EXPECT_EQ(master.model.counters().faults_injected, script.kind == FaultKind::none ? 0u : 1u);
  }
}

TEST(LinkModel, JudgesTheMaster) {
  Master twice("harp");
  AxiRequest request{};
  request.single_beats = true;
  request.ar_valid = true;
  request.ar_address = twice.address(0);
  for (int i = 0; i < 3; ++i) {
    twice.model.drive();
    twice.model.sample(request);
  }
  EXPECT_EQ(twice.model.breach(), "two reads outstanding with one ID");

  Master burst("harp");
  request.single_beats = false;
  burst.model.drive();
  burst.model.sample(request);
  EXPECT_NE(burst.model.breach(), "");
}

}  // namespace
}  // namespace harpoon::sim
