// The cpu device: cuts a batch into tasks for the executor and finishes it inside submit.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <new>

#include "base/executor.hpp"
#include "base/float_environment.hpp"
#include "base/out_of_memory.hpp"
#include "device/cpu/indexed_batch.hpp"
#include "device/cpu/kernels.hpp"
#include "device/validate.hpp"
#include "harpoon/device.hpp"

namespace harpoon {
namespace {

constexpr unsigned kMaxThreads = 1024;
/// Below this many pairs a second thread costs more than it gains.
constexpr std::size_t kParallelPairs = 32768;
/// Tasks for each thread, so that a slow one does not hold up the rest.
constexpr std::size_t kTasksPerThread = 8;
/// Task boundaries fall on multiples of this, so that only the last task has a tail.
constexpr std::size_t kTaskGranularity = 256;
/// Above this many bytes of records in and out, contacts bypass the caches: by the time anybody
/// reads them they would have left.
constexpr std::size_t kStreamBytes = std::size_t{48} << 20;

class CpuDevice final : public Device {
 public:
  CpuDevice(const CpuOptions& options, const cpu::Kernels& kernels)
      : kernels_(kernels), executor_(options.threads, options.parallel_for) {
    capabilities_.description =
        fmt::format("SIMD {}, {} thread{}",
                    options.instruction_set.empty() ? std::string(cpu::widest_instruction_set())
                                                    : options.instruction_set,
                    executor_.threads(), executor_.threads() == 1 ? "" : "s");
    capabilities_.f32 = capabilities_.f64 = true;
    capabilities_.pair_batches = capabilities_.array_batches = capabilities_.indexed_batches = true;
  }

  [[nodiscard]] std::string_view name() const noexcept override { return "cpu"; }
  [[nodiscard]] const Capabilities& capabilities() const noexcept override { return capabilities_; }

  [[nodiscard]] Transaction submit(const Batch& batch) noexcept override {
    return Transaction(CpuDevice::run(batch));
  }

  [[nodiscard]] Result<Outcome> run(const Batch& batch) noexcept override {
    try {
      if (auto error = validate(batch)) return *std::move(error);
      return std::visit([this](const auto& b) { return run_batch(b); }, batch);
    } catch (const std::bad_alloc&) {
      return out_of_memory();
    }
  }

 private:
  template <class Real>
  Result<Outcome> run_batch(const PairBatch<Real>& batch) {
    const std::size_t count = batch.pairs.size();
    const bool stream = count * (sizeof batch.pairs[0] + sizeof batch.contacts[0]) > kStreamBytes;
    return in_tasks(count, [&](std::size_t begin, std::size_t end) {
      return kernels_.of<Real>().pairs(batch.pairs.data() + begin, end - begin,
                                       batch.contacts.data() + begin, stream);
    });
  }

  template <class Real>
  Result<Outcome> run_batch(const PairArraysBatch<Real>& batch) {
    return in_tasks(batch.pairs.count, [&](std::size_t begin, std::size_t end) {
      return kernels_.of<Real>().arrays(batch.pairs, begin, end, batch.contacts);
    });
  }

  template <class Real>
  Result<Outcome> run_batch(const IndexedBatch<Real>& batch) {
    return cpu::run_indexed(kernels_, executor_, batch);
  }

  /// Runs `kernel(begin, end)` over [0, count) and adds up the hits that it returns.
  template <class Kernel>
  Result<Outcome> in_tasks(std::size_t count, const Kernel& kernel) {
    if (count == 0) return Outcome{};
    if (count < kParallelPairs) {
      const FloatEnvironment environment;
      return Outcome{.pairs = count, .hits = kernel(0, count)};
    }
    const std::size_t wanted_tasks = kTasksPerThread * executor_.threads();
    const std::size_t task_pairs =
        (count / wanted_tasks + kTaskGranularity) / kTaskGranularity * kTaskGranularity;
    const std::size_t tasks = (count + task_pairs - 1) / task_pairs;
    std::atomic<std::uint64_t> hits{0};
    if (auto error = executor_.run(tasks, [&](std::size_t task) {
          const std::size_t begin = task * task_pairs;
          hits += kernel(begin, std::min(count, begin + task_pairs));
        })) {
      return *std::move(error);
    }
    return Outcome{.pairs = count, .hits = hits};
  }

  const cpu::Kernels& kernels_;
  Executor executor_;
  Capabilities capabilities_;
};

}  // namespace

Result<std::unique_ptr<Device>> make_cpu_device(const CpuOptions& options) noexcept {
  try {
    if (options.threads > kMaxThreads) {
      return Error{Errc::invalid_argument, fmt::format("{} threads asked for, the limit is {}",
                                                       options.threads, kMaxThreads)};
    }
    const cpu::Kernels* kernels = cpu::find_kernels(options.instruction_set);
    if (kernels == nullptr) {
      return Error{
          Errc::invalid_argument,
          fmt::format("instruction set \"{}\" is not to be had here; this machine has {}",
                      options.instruction_set, fmt::join(cpu::instruction_set_names(), ", "))};
    }
    return std::unique_ptr<Device>(std::make_unique<CpuDevice>(options, *kernels));
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

std::vector<std::string> cpu_instruction_sets() {
  return cpu::instruction_set_names();
}

}  // namespace harpoon
