// A transaction's batch is finished exactly once: by wait, by assignment over it, or by its end.

#include <gtest/gtest.h>

#include "harpoon/device.hpp"

namespace harpoon {
namespace {

struct Counting final : Transaction::Pending {
  explicit Counting(int& count) : finished(count) {}
  Result<Outcome> finish() override {
    ++finished;
    return Outcome{.pairs = 5, .hits = 3};
  }
  int& finished;
};

TEST(Transaction, WaitsOnceAndKeepsTheResult) {
  int finished = 0;
  Transaction transaction(std::make_unique<Counting>(finished));
  EXPECT_EQ(finished, 0);
  EXPECT_EQ(transaction.wait()->hits, 3u);
  EXPECT_EQ(transaction.wait()->pairs, 5u);
  EXPECT_EQ(finished, 1);
}

TEST(Transaction, FinishesWhenItEnds) {
  int finished = 0;
  { const Transaction transaction(std::make_unique<Counting>(finished)); }
  EXPECT_EQ(finished, 1);
}

TEST(Transaction, MovesWithoutFinishing) {
  int finished = 0;
  Transaction first(std::make_unique<Counting>(finished));
  Transaction second(std::move(first));
  EXPECT_EQ(finished, 0);
  EXPECT_EQ(second.wait()->hits, 3u);
  EXPECT_EQ(finished, 1);
}

TEST(Transaction, FinishesWhatIsAssignedOver) {
  int lost = 0;
  int kept = 0;
  Transaction transaction(std::make_unique<Counting>(lost));
  transaction = Transaction(std::make_unique<Counting>(kept));
  EXPECT_EQ(lost, 1);
  EXPECT_EQ(kept, 0);
  EXPECT_TRUE(transaction.wait());
  EXPECT_EQ(kept, 1);
}

TEST(Transaction, CarriesAnError) {
  Transaction transaction(Error{Errc::device_timeout, "silent"});
  ASSERT_FALSE(transaction.wait());
  EXPECT_EQ(transaction.wait().error().code, Errc::device_timeout);
}

}  // namespace
}  // namespace harpoon
