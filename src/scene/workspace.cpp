#include "scene/workspace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <new>
#include <thread>

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
    return Error{Errc::out_of_memory, "out of memory"};
  }
}

Workspace::Workspace(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
Workspace::Workspace(Workspace&& other) noexcept = default;
Workspace& Workspace::operator=(Workspace&& other) noexcept = default;
Workspace::~Workspace() = default;

std::size_t Workspace::bytes() const noexcept {
  const broad::OrderMemory& o = state_->order;
  std::size_t sum = 0;
  const std::initializer_list<const Buffer*> buffers = {&o.staged,
                                                        &o.staged_ids,
                                                        &o.parted,
                                                        &o.parted_ids,
                                                        &o.parted_buckets,
                                                        &o.buckets,
                                                        &o.tables,
                                                        &o.counts,
                                                        &o.sorted,
                                                        &o.ids,
                                                        &o.cull,
                                                        &state_->trees.items,
                                                        &state_->trees.spare,
                                                        &state_->trees.codes,
                                                        &state_->trees.boxes,
                                                        &state_->boxes.corners,
                                                        &state_->boxes.high,
                                                        &state_->boxes.low,
                                                        &state_->scratch};
  for (const Buffer* buffer : buffers) sum += buffer->bytes();
  sum += state_->by_id.bytes();
  for (const broad::TaskList& list : state_->search.lists) sum += list.memory.bytes();
  return sum;
}

broad::Means Workspace::State::means(std::size_t bodies) const noexcept {
  return {{bodies < kParallelBodies ? nullptr : executor.get()}, kernels};
}

}  // namespace harpoon
