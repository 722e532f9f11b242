#include "scene/workspace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <thread>

#include "base/out_of_memory.hpp"

namespace harpoon {
namespace {

constexpr unsigned kMaxThreads = 1024;
/// Smaller calls stay on the calling thread.
constexpr std::size_t kParallelBodies = 4096;

}  // namespace

Result<Workspace> Workspace::make(const WorkspaceOptions& options) noexcept {
  try {
    if (options.threads > kMaxThreads) {
      return Error{Errc::invalid_argument, fmt::format("{} threads asked for, the limit is {}",
                                                       options.threads, kMaxThreads)};
    }
    auto state = std::make_unique<State>();
    state->kernels = broad::find_kernels(options.instruction_set);
    if (state->kernels == nullptr) {
      return Error{Errc::invalid_argument,
                   fmt::format("instruction set \"{}\" is not to be had here; "
                               "cpu_instruction_sets() lists those that are",
                               options.instruction_set)};
    }
    const unsigned threads =
        options.threads != 0 ? options.threads : std::max(1U, std::thread::hardware_concurrency());
    if (threads > 1 || options.parallel_for) {
      state->executor = std::make_unique<Executor>(threads, options.parallel_for);
    }
    return Workspace(std::move(state));
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

Workspace::Workspace(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
Workspace::Workspace(Workspace&& other) noexcept = default;
Workspace& Workspace::operator=(Workspace&& other) noexcept = default;
Workspace::~Workspace() = default;

std::size_t Workspace::bytes() const noexcept {
  const State& s = *state_;
  return bytes_of(s.order, s.trees, s.boxes, s.search, s.by_id, s.scratch);
}

broad::Means Workspace::State::means(std::size_t bodies) const noexcept {
  return {{bodies < kParallelBodies ? nullptr : executor.get()}, kernels};
}

}  // namespace harpoon
