#include "base/executor.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <new>
#include <thread>
#include <utility>
#include <vector>

#include "base/float_environment.hpp"

#if defined(HARPOON_TELLS_THREAD_SANITIZER)
#include <sanitizer/tsan_interface.h>
#endif

namespace harpoon {
namespace {

// oneTBB is not instrumented, so the thread sanitizer is told what parallel_for promises: what was
// before the call comes before every task, and every task before the return.
#if defined(HARPOON_TELLS_THREAD_SANITIZER)
void publish(void* point) {
  __tsan_release(point);
}
void observe(void* point) {
  __tsan_acquire(point);
}
#else
void publish(void* /*point*/) {}
void observe(void* /*point*/) {}
#endif

/// Counts what an injected parallel_for really ran.
class Tally {
 public:
  explicit Tally(std::size_t tasks) : ran_(tasks) {}

  /// True when `task` exists and runs for the first time.
  bool begin(std::size_t task) noexcept {
    if (task < ran_.size() && !ran_[task].exchange(true)) return true;
    excess_ = true;
    return false;
  }
  [[nodiscard]] bool complete() const noexcept {
    return !excess_ &&
           std::all_of(ran_.begin(), ran_.end(), [](const auto& r) { return r.load(); });
  }

 private:
  std::vector<std::atomic<bool>> ran_;
  std::atomic<bool> excess_{false};
};

Error executor_error(const char* what) {
  return {Errc::executor_failed, std::string("the injected parallel_for ") + what};
}

std::optional<Error> run_injected(const ParallelFor& parallel_for, std::size_t tasks,
                                  const std::function<void(std::size_t)>& body) {
  Tally tally(tasks);
  try {
    parallel_for(tasks, [&](std::size_t task) {
      if (!tally.begin(task)) return;
      const FloatEnvironment environment;
      body(task);
    });
  } catch (...) {
    return executor_error("threw; it must run every task and not throw");
  }
  if (tally.complete()) return std::nullopt;
  return executor_error("did not run every task exactly once before it returned");
}

}  // namespace

class Executor::Arena {
 public:
  explicit Arena(unsigned threads)
      : arena_(static_cast<int>(std::min<std::size_t>(threads, most_threads()))) {}

  void run(std::size_t tasks, const std::function<void(std::size_t)>& body) {
    char begin = 0;
    char end = 0;
    publish(&begin);
    arena_.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<std::size_t>(0, tasks, 1),
          [&](const tbb::blocked_range<std::size_t>& range) {
            observe(&begin);
            const FloatEnvironment environment;
            for (std::size_t task = range.begin(); task != range.end(); ++task) body(task);
            publish(&end);
          },
          tbb::simple_partitioner());
    });
    observe(&end);
  }

 private:
  /// Asked for more, oneTBB would print a warning and give no more.
  static std::size_t most_threads() {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  }

  tbb::task_arena arena_;
};

Executor::Executor(unsigned threads, ParallelFor injected)
    : threads_(threads != 0 ? threads : std::max(1U, std::thread::hardware_concurrency())),
      injected_(std::move(injected)) {
  if (!injected_ && threads_ > 1) arena_ = std::make_unique<Arena>(threads_);
}

Executor::~Executor() = default;

std::optional<Error> Executor::run(std::size_t tasks,
                                   const std::function<void(std::size_t)>& body) noexcept {
  try {
    if (injected_ && tasks > 1) return run_injected(injected_, tasks, body);
    if (arena_ && tasks > 1) {
      arena_->run(tasks, body);
      return std::nullopt;
    }
    const FloatEnvironment environment;
    for (std::size_t task = 0; task < tasks; ++task) body(task);
    return std::nullopt;
  } catch (const std::bad_alloc&) {
    return Error{Errc::out_of_memory, "out of memory"};
  } catch (...) {
    return Error{Errc::executor_failed, "task failed"};
  }
}

}  // namespace harpoon
