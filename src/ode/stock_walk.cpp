#include "ode/stock_walk.hpp"

#include <sys/mman.h>
#include <unistd.h>

namespace harpoon::ode {
namespace {

/// Only what is touched becomes memory. A program's AABB tests and bounds run here, too.
constexpr std::size_t kStackBytes = std::size_t{1} << 20;
/// How many stacks a thread keeps: calls within callbacks of calls need one each.
constexpr std::size_t kMostSpare = 8;

std::size_t guard_bytes() {
  static const auto kPage = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  return kPage;
}

void* map_stack() noexcept {
  const std::size_t guard = guard_bytes();
  void* const memory = ::mmap(nullptr, guard + kStackBytes, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0);
  if (memory == MAP_FAILED) return nullptr;
  if (::mprotect(memory, guard, PROT_NONE) == 0) return memory;
  ::munmap(memory, guard + kStackBytes);
  return nullptr;
}

/// A thread's spare stacks.
struct Spare {
  Spare() = default;
  Spare(const Spare&) = delete;
  Spare& operator=(const Spare&) = delete;
  ~Spare() {
    while (count > 0) ::munmap(memory[--count], guard_bytes() + kStackBytes);
  }
  void* memory[kMostSpare] = {};
  std::size_t count = 0;
};

Spare& spare() {
  static thread_local Spare stacks;
  return stacks;
}

/// Handed to `begin`, which takes no argument that could hold a pointer.
constinit thread_local Walk* beginning = nullptr;

}  // namespace

std::optional<WalkStack> WalkStack::take() noexcept {
  Spare& stacks = spare();
  void* const memory = stacks.count > 0 ? stacks.memory[--stacks.count] : map_stack();
  if (memory == nullptr) return std::nullopt;
  return WalkStack(memory);
}

WalkStack::~WalkStack() {
  if (memory_ == nullptr) return;
  Spare& stacks = spare();
  if (stacks.count < kMostSpare) {
    stacks.memory[stacks.count++] = memory_;
  } else {
    ::munmap(memory_, guard_bytes() + kStackBytes);
  }
}

void* WalkStack::begin() const {
  return static_cast<char*>(memory_) + guard_bytes();
}

std::size_t WalkStack::size() {
  return kStackBytes;
}

Walk::Walk(Run* run, const void* traversal, WalkStack stack)
    : run_(run), traversal_(traversal), stack_(std::move(stack)) {}

Walk::~Walk() {
  if (!begun_) return;
  try {
    GeomPair rest;
    while (next(rest)) {
    }
  } catch (...) {
    ended_ = true;  // libode's own failure, of a call that nobody waits for
  }
}

bool Walk::next(GeomPair& pair) {
  if (ended_) return false;
  resume();
  pair = pair_;
  return !ended_;
}

bool Walk::skip_to(GeomPair pair) {
  sought_ = pair;
  GeomPair found;
  return next(found);
}

void Walk::resume() {
  if (!begun_) {
    begun_ = true;
    ::getcontext(&inside_);
    inside_.uc_stack.ss_sp = stack_.begin();
    inside_.uc_stack.ss_size = WalkStack::size();
    inside_.uc_link = &outside_;
    ::makecontext(&inside_, &Walk::begin, 0);
    beginning = this;
  }
  ::swapcontext(&outside_, &inside_);
  if (error_ != nullptr) std::rethrow_exception(std::exchange(error_, nullptr));
}

void Walk::begin() {
  Walk& walk = *beginning;
  try {
    walk.run_(walk.traversal_, &walk, &Walk::near);
  } catch (...) {
    walk.error_ = std::current_exception();
  }
  walk.ended_ = true;
}

void Walk::near(void* walk, dxGeom* o1, dxGeom* o2) {
  Walk& self = *static_cast<Walk*>(walk);
  const GeomPair pair{o1, o2};
  if (self.sought_ && *self.sought_ != pair) return;
  self.sought_.reset();
  self.pair_ = pair;
  ::swapcontext(&self.inside_, &self.outside_);
}

}  // namespace harpoon::ode
