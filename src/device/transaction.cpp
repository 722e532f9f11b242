#include <utility>

#include "harpoon/device.hpp"

namespace harpoon {

Transaction::Transaction(Result<Outcome> done) noexcept : result_(std::move(done)) {}

Transaction::Transaction(std::unique_ptr<Pending> pending) noexcept
    : pending_(std::move(pending)), result_(Outcome{}) {}

Transaction::Transaction(Transaction&& other) noexcept = default;

Transaction& Transaction::operator=(Transaction&& other) noexcept {
  if (this != &other) {
    wait();
    pending_ = std::move(other.pending_);
    result_ = std::move(other.result_);
  }
  return *this;
}

Transaction::~Transaction() {
  wait();
}

const Result<Outcome>& Transaction::wait() noexcept {
  if (const std::unique_ptr<Pending> pending = std::move(pending_)) result_ = pending->finish();
  return result_;
}

Result<Outcome> Device::run(const Batch& batch) noexcept {
  return submit(batch).wait();
}

}  // namespace harpoon
