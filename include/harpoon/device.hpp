#pragma once

/// Devices: machines that turn a batch of candidate pairs into contacts.
///
/// Every device gives the same bits for the same batch: IEEE-754 round to nearest even, subnormals
/// kept, no contraction, operations in ODE's order (`sphere_sphere`). A NaN is a NaN: its sign and
/// payload are unspecified. The caller's floating-point environment (rounding mode, FTZ/DAZ,
/// exception flags and masks) has no influence and is left as it was.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "harpoon/error.hpp"
#include "harpoon/export.hpp"
#include "harpoon/records.hpp"

namespace harpoon {

/// The largest batch: 2^31 pairs.
inline constexpr std::uint64_t kMaxBatchPairs = std::uint64_t{1} << 31;

/// One contact record per pair, in pair order. `contacts` must hold at least `pairs.size()` records
/// (else Errc::capacity) and must not overlap `pairs`; both are aligned as their types are (else
/// Errc::invalid_argument).
template <class Real>
struct PairBatch {
  std::span<const SpherePairOf<Real>> pairs;
  std::span<ContactOf<Real>> contacts;
};

/// The same on separate arrays. `contacts.count` must be at least `pairs.count`.
template <class Real>
struct PairArraysBatch {
  SpherePairArraysOf<Real> pairs;
  ContactArraysOf<Real> contacts;
};

/// Pairs of a sphere array by index; only hits are written, in pair order, without gaps.
/// Every index must be below `spheres.size()` (else Errc::invalid_index, output untouched). When
/// there are more hits than `contacts.size()`, the first `contacts.size()` of them are written and
/// the error Errc::capacity carries the number of all hits in `needed`. A pair of a body with
/// itself is computed like any other (coincident centres: Flow 2).
template <class Real>
struct IndexedBatch {
  std::span<const SphereOf<Real>> spheres;
  std::span<const IndexPair> pairs;
  std::span<BodyContactOf<Real>> contacts;
};

/// Everything that can be submitted. Views only: the caller keeps the buffers alive and unchanged,
/// and does not read the outputs, until `Transaction::wait` has returned.
using Batch = std::variant<PairBatch<float>, PairBatch<double>, PairArraysBatch<float>,
                           PairArraysBatch<double>, IndexedBatch<float>, IndexedBatch<double>>;

/// What a finished batch did.
struct Outcome {
  std::uint64_t pairs = 0;  ///< pairs tested
  std::uint64_t hits = 0;   ///< contacts found (grazing and real)
  /// Device time in nanoseconds where the device is simulated; empty on real machines.
  std::optional<double> modelled_ns = {};
};

/// A submitted batch. Movable, single owner; waiting twice returns the same result.
/// Destroying it waits first, so that buffers are never written after the owner is gone.
class HARPOON_API Transaction {
 public:
  /// What a device keeps about a batch under way. `finish` is called at most once.
  class Pending {
   public:
    virtual ~Pending() = default;
    virtual Result<Outcome> finish() = 0;
  };

  /// A batch that is already done.
  explicit Transaction(Result<Outcome> done) noexcept;
  /// A batch under way.
  explicit Transaction(std::unique_ptr<Pending> pending) noexcept;
  Transaction(Transaction&& other) noexcept;
  Transaction& operator=(Transaction&& other) noexcept;
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction();

  /// Blocks until the batch is finished or has failed. Not thread-safe on one Transaction.
  const Result<Outcome>& wait() noexcept;

 private:
  std::unique_ptr<Pending> pending_;
  Result<Outcome> result_;
};

/// What a device can do.
struct Capabilities {
  std::string description;  ///< one line: the machine, the instruction set, the threads
  bool f32 = false;
  bool f64 = false;
  bool pair_batches = false;
  bool array_batches = false;
  bool indexed_batches = false;
  bool modelled = false;  ///< times are those of a simulation, not measured
};

/// One machine. Thread-safe: any number of threads may submit to one Device at the same time.
class HARPOON_API Device {
 public:
  virtual ~Device() = default;

  /// Short lower-case name, for example "cpu".
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  [[nodiscard]] virtual const Capabilities& capabilities() const noexcept = 0;

  /// Starts a batch. Errors (bad arguments as well as device failures) come from
  /// `Transaction::wait`. An empty batch is legal. The cpu device finishes before it returns.
  [[nodiscard]] virtual Transaction submit(const Batch& batch) noexcept = 0;

  /// `submit` and wait.
  [[nodiscard]] virtual Result<Outcome> run(const Batch& batch) noexcept;
};

/// Runs `body(i)` once for every i in [0, tasks), in any order and on any threads, and returns when
/// all have finished. Bodies never throw.
using ParallelFor =
    std::function<void(std::size_t tasks, const std::function<void(std::size_t task)>& body)>;

struct CpuOptions {
  /// Most threads to use, 1 to 1024; 0 means one per hardware thread. Small batches stay on the
  /// calling thread whatever this says.
  unsigned threads = 0;
  /// Replaces oneTBB. A device with `parallel_for` still cuts work for `threads` threads.
  ParallelFor parallel_for = {};
  /// Name of the widest instruction set to use, as listed by `cpu_instruction_sets`; empty means
  /// the widest that this machine has.
  std::string instruction_set = {};
};

/// The cpu device: always present. Errors: invalid_argument (unknown or absent instruction set, too
/// many threads), out_of_memory.
HARPOON_API Result<std::unique_ptr<Device>> make_cpu_device(
    const CpuOptions& options = {}) noexcept;

/// Instruction sets that this build holds and this machine runs, narrowest first ("SSE2", "AVX2",
/// ...). All give the same bits.
HARPOON_API std::vector<std::string> cpu_instruction_sets();

enum class LogLevel : std::uint8_t { info, warning, error };
/// Receives one line per event, without newline; may be called from any thread.
using LogCallback = std::function<void(LogLevel level, std::string_view line)>;

/// A device that answers on `primary` and, when a batch fails there because of the device
/// (device_unavailable, device_timeout, device_fault, unsupported, out_of_memory), runs the batch
/// again on `fallback`: nothing lost, nothing doubled. The first such event is logged, all are
/// counted. Errors of the caller (arguments, indices, capacity) are passed on.
class HARPOON_API FallbackDevice final : public Device {
 public:
  /// Both devices must be non-null. `log` may be empty.
  FallbackDevice(std::unique_ptr<Device> primary, std::unique_ptr<Device> fallback,
                 LogCallback log = {}) noexcept;
  ~FallbackDevice() override;

  [[nodiscard]] std::string_view name() const noexcept override;
  [[nodiscard]] const Capabilities& capabilities() const noexcept override;
  [[nodiscard]] Transaction submit(const Batch& batch) noexcept override;

  /// Batches that were redone on the fallback so far.
  [[nodiscard]] std::uint64_t fallbacks() const noexcept;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

/// One row of the list of devices.
struct DeviceInfo {
  std::string name;
  bool available = false;
  std::string description;  ///< what it is, or why it is absent and how to get it
  bool modelled = false;
};

/// The devices that the library itself can open, cpu first. Others a program puts together and
/// owns, as the `harpoon` command does with its simulated AFU: these are not listed.
HARPOON_API std::vector<DeviceInfo> list_devices();

/// Opens a device of `list_devices` by name, with default options. Errors: invalid_argument
/// (another name; the message lists the known ones), device_unavailable (one that is listed as not
/// available), out_of_memory.
HARPOON_API Result<std::unique_ptr<Device>> open_device(std::string_view name) noexcept;

/// Algorithm 1 for a single pair on the calling thread; the bits of every device. Thread-safe.
HARPOON_API Contact collide(const SpherePair& pair) noexcept;
HARPOON_API ContactF64 collide(const SpherePairF64& pair) noexcept;

}  // namespace harpoon
