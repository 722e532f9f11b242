#include "apps/counted_memory.hpp"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> taken = 0, most = 0, at_reset = 0;

void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  const std::size_t now = taken += malloc_usable_size(memory);
  std::size_t before = most;
  while (before < now && !most.compare_exchange_weak(before, now)) continue;
  return memory;
}

void returned(void* memory) {
  if (memory == nullptr) return;
  taken -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t bytes) {
  return counted(std::malloc(bytes));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return counted(std::aligned_alloc(static_cast<std::size_t>(alignment),
                                    (bytes + static_cast<std::size_t>(alignment) - 1) &
                                        ~(static_cast<std::size_t>(alignment) - 1)));
}
void operator delete(void* memory) noexcept {
  returned(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  returned(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  returned(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  returned(memory);
}

namespace harpoon::app {

std::size_t peak_bytes() {
  return most - at_reset;
}

void reset_peak() {
  at_reset = most = taken.load();
}

}  // namespace harpoon::app
