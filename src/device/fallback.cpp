// Redoes a batch on a second device when the first one failed as a machine.

#include <atomic>
#include <mutex>
#include <utility>

#include "harpoon/device.hpp"

namespace harpoon {
namespace {

/// True for failures of the machine; false for those of the caller, which a second device shares.
bool is_device_failure(Errc code) noexcept {
  switch (code) {
    case Errc::device_unavailable:
    case Errc::device_timeout:
    case Errc::device_fault:
    case Errc::unsupported:
    case Errc::out_of_memory:
      return true;
    default:
      return false;
  }
}

}  // namespace

struct FallbackDevice::State {
  std::unique_ptr<Device> primary;
  std::unique_ptr<Device> fallback;
  LogCallback log;
  std::once_flag logged;
  std::atomic<std::uint64_t> fallbacks{0};

  Result<Outcome> redo(const Batch& batch, const Error& error) noexcept {
    ++fallbacks;
    try {
      std::call_once(logged, [&] {
        if (!log) return;
        log(LogLevel::warning, std::string("device ") + std::string(primary->name()) + " failed (" +
                                   error.message + "); batches go to " +
                                   std::string(fallback->name()));
      });
    } catch (...) {
      // A log that fails must not cost the batch.
    }
    return fallback->run(batch);
  }
};

namespace {

/// A batch under way on the primary device, with what it takes to redo it.
template <class State>
class PendingWithFallback final : public Transaction::Pending {
 public:
  PendingWithFallback(std::shared_ptr<State> state, const Batch& batch, Transaction transaction)
      : state_(std::move(state)), batch_(batch), transaction_(std::move(transaction)) {}

  Result<Outcome> finish() override {
    const Result<Outcome>& result = transaction_.wait();
    if (result || !is_device_failure(result.error().code)) return result;
    return state_->redo(batch_, result.error());
  }

 private:
  std::shared_ptr<State> state_;
  Batch batch_;
  Transaction transaction_;
};

}  // namespace

FallbackDevice::FallbackDevice(std::unique_ptr<Device> primary, std::unique_ptr<Device> fallback,
                               LogCallback log) noexcept
    : state_(std::make_shared<State>()) {
  state_->primary = std::move(primary);
  state_->fallback = std::move(fallback);
  state_->log = std::move(log);
}

FallbackDevice::~FallbackDevice() = default;

std::string_view FallbackDevice::name() const noexcept {
  return state_->primary->name();
}

const Capabilities& FallbackDevice::capabilities() const noexcept {
  return state_->primary->capabilities();
}

std::uint64_t FallbackDevice::fallbacks() const noexcept {
  return state_->fallbacks;
}

Transaction FallbackDevice::submit(const Batch& batch) noexcept {
  try {
    auto transaction = state_->primary->submit(batch);
    return Transaction(
        std::make_unique<PendingWithFallback<State>>(state_, batch, std::move(transaction)));
  } catch (const std::bad_alloc&) {
    return Transaction(state_->redo(batch, Error{Errc::out_of_memory, "out of memory"}));
  }
}

}  // namespace harpoon
