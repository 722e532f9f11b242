// A batch that fails on its device is redone on the fallback: exactly once, with the exact result.

#include <gtest/gtest.h>

#include "harpoon/device.hpp"
#include "support/pairs.hpp"

namespace harpoon {
namespace {

/// A device that damages its output and then fails with a given code, at submit or at wait.
class BrokenDevice final : public Device {
 public:
  BrokenDevice(Errc code, bool at_wait) : code_(code), at_wait_(at_wait) {}

  [[nodiscard]] std::string_view name() const noexcept override { return "broken"; }
  [[nodiscard]] const Capabilities& capabilities() const noexcept override { return none_; }
  [[nodiscard]] Transaction submit(const Batch& batch) noexcept override {
    for (Contact& c : std::get<PairBatch<float>>(batch).contacts) c.depth = -77;
    const Error error{code_, "the cable is out"};
    if (at_wait_) return Transaction(std::make_unique<Failing>(error));
    return Transaction(error);
  }

 private:
  struct Failing final : Transaction::Pending {
    explicit Failing(Error e) : error(std::move(e)) {}
    Result<Outcome> finish() override { return error; }
    Error error;
  };

  Errc code_;
  bool at_wait_;
  Capabilities none_;
};

struct Log {
  std::vector<std::string> lines;
  LogCallback callback() {
    return [this](LogLevel level, std::string_view line) {
      EXPECT_EQ(level, LogLevel::warning);
      lines.emplace_back(line);
    };
  }
};

TEST(FallbackDevice, RedoesFailedBatchesAndSaysSoOnce) {
  for (const bool at_wait : {false, true}) {
    for (const Errc code : {Errc::device_unavailable, Errc::device_timeout, Errc::device_fault,
                            Errc::unsupported, Errc::out_of_memory}) {
      Log log;
      FallbackDevice device(std::make_unique<BrokenDevice>(code, at_wait), *make_cpu_device(),
                            log.callback());
      const auto pairs = test::random_pairs<float>(1, 100);
      for (int round = 1; round <= 3; ++round) {
        std::vector<Contact> contacts(pairs.size());
        const auto outcome = device.run(PairBatch<float>{pairs, contacts});
        ASSERT_TRUE(outcome) << outcome.error().message;
        EXPECT_EQ(outcome->pairs, pairs.size());
        for (std::size_t i = 0; i < pairs.size(); ++i) {
          ASSERT_TRUE(test::same_contact(contacts[i], test::algorithm_1(pairs[i])));
        }
        EXPECT_EQ(device.fallbacks(), static_cast<std::uint64_t>(round));
      }
      ASSERT_EQ(log.lines.size(), 1u);
      EXPECT_NE(log.lines[0].find("broken"), std::string::npos);
      EXPECT_NE(log.lines[0].find("the cable is out"), std::string::npos);
      EXPECT_NE(log.lines[0].find("cpu"), std::string::npos);
    }
  }
}

TEST(FallbackDevice, PassesTheCallersOwnErrorsOn) {
  for (const Errc code : {Errc::invalid_argument, Errc::invalid_index, Errc::capacity,
                          Errc::batch_too_large, Errc::executor_failed}) {
    FallbackDevice device(std::make_unique<BrokenDevice>(code, true), *make_cpu_device());
    const auto pairs = test::random_pairs<float>(1, 10);
    std::vector<Contact> contacts(pairs.size());
    const auto outcome = device.run(PairBatch<float>{pairs, contacts});
    ASSERT_FALSE(outcome);
    EXPECT_EQ(outcome.error().code, code);
    EXPECT_EQ(device.fallbacks(), 0u);
  }
}

TEST(FallbackDevice, IsItsPrimaryWhileThatWorks) {
  FallbackDevice device(*make_cpu_device(),
                        std::make_unique<BrokenDevice>(Errc::device_fault, false));
  EXPECT_EQ(device.name(), "cpu");
  EXPECT_TRUE(device.capabilities().f64);
  const auto pairs = test::random_pairs<float>(1, 10);
  std::vector<Contact> contacts(pairs.size());
  EXPECT_TRUE(device.run(PairBatch<float>{pairs, contacts}));
  EXPECT_EQ(device.fallbacks(), 0u);
}

TEST(FallbackDevice, ALogThatThrowsCostsNothing) {
  FallbackDevice device(std::make_unique<BrokenDevice>(Errc::device_fault, true),
                        *make_cpu_device(), [](LogLevel, std::string_view) { throw 1; });
  const auto pairs = test::random_pairs<float>(1, 10);
  std::vector<Contact> contacts(pairs.size());
  EXPECT_TRUE(device.run(PairBatch<float>{pairs, contacts}));
}

}  // namespace
}  // namespace harpoon
