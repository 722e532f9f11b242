#pragma once

// Where the library's parallel loops run: oneTBB in an arena of its own, or the caller's
// parallel_for. Says so when tasks were lost; never throws.

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

#include "harpoon/device.hpp"
#include "harpoon/error.hpp"

namespace harpoon {

class Executor {
 public:
  /// `threads` 0 means one per hardware thread. Throws std::bad_alloc only.
  Executor(unsigned threads, ParallelFor injected);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  [[nodiscard]] unsigned threads() const noexcept { return threads_; }

  /// Runs body(i) once for every i in [0, tasks) in the contract's floating-point environment; on
  /// the calling thread when there is one task or one thread and nothing was injected. The body
  /// must not throw. Errors: out_of_memory (some tasks may have run), executor_failed. Thread-safe.
  std::optional<Error> run(std::size_t tasks,
                           const std::function<void(std::size_t task)>& body) noexcept;

 private:
  class Arena;
  unsigned threads_;
  ParallelFor injected_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace harpoon
