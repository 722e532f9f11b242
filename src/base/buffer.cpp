#include "base/buffer.hpp"

#include <cstring>
#include <new>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace harpoon {
namespace {

constexpr std::size_t kCacheLine = 64;
constexpr std::size_t kLargePage = std::size_t{2} << 20;
/// From this size on large pages are asked for: random access over it misses the TLB otherwise.
constexpr std::size_t kLargePageBytes = std::size_t{4} << 20;

std::align_val_t alignment_of(std::size_t bytes) noexcept {
  return std::align_val_t{bytes >= kLargePageBytes ? kLargePage : kCacheLine};
}

/// Some room to grow, whole pages where it is large.
std::size_t rounded(std::size_t bytes) noexcept {
  const std::size_t roomy = bytes + bytes / 8;
  const std::size_t unit = roomy >= kLargePageBytes ? kLargePage : kCacheLine;
  return (roomy + unit - 1) / unit * unit;
}

}  // namespace

void* allocate_large(std::size_t bytes) noexcept {
  void* const memory = ::operator new(bytes, alignment_of(bytes), std::nothrow);
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  if (memory != nullptr && bytes >= kLargePageBytes) {
    madvise(memory, bytes, MADV_HUGEPAGE);  // a hint: without large pages it is only slower
  }
#endif
  return memory;
}

void deallocate_large(void* memory, std::size_t bytes) noexcept {
  ::operator delete(memory, alignment_of(bytes), std::nothrow);
}

Buffer::Buffer(Buffer&& other) noexcept
    : memory_(std::exchange(other.memory_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(memory_, other.memory_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

bool Buffer::reserve(std::size_t bytes) noexcept {
  return bytes <= bytes_ || grow(bytes, 0);
}

bool Buffer::grow(std::size_t bytes, std::size_t used_bytes) noexcept {
  if (bytes <= bytes_) return true;
  if (bytes > static_cast<std::size_t>(-1) / 4) return false;
  const std::size_t wanted = rounded(bytes);
  if (used_bytes == 0) release();
  void* const memory = allocate_large(wanted);
  if (memory == nullptr) return false;
  if (used_bytes != 0) {
    std::memcpy(memory, memory_, used_bytes);
    release();
  }
  memory_ = memory;
  bytes_ = wanted;
  return true;
}

void Buffer::release() noexcept {
  if (memory_ != nullptr) deallocate_large(memory_, bytes_);
  memory_ = nullptr;
  bytes_ = 0;
}

}  // namespace harpoon
