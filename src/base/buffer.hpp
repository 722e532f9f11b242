#pragma once

// Scratch memory that grows and is kept. Allocation failure is a return value; contents are lost
// when it grows.

#include <cstddef>
#include <new>

namespace harpoon {

/// Cache-line-aligned memory, in large pages where it is large; null when there is none.
void* allocate_large(std::size_t bytes) noexcept;
void deallocate_large(void* memory, std::size_t bytes) noexcept;

class Buffer {
 public:
  Buffer() = default;
  ~Buffer() { release(); }
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&& other) noexcept;
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  /// At least `bytes` of cache-line-aligned memory, of unspecified contents. False when there is
  /// none.
  [[nodiscard]] bool reserve(std::size_t bytes) noexcept;
  /// The same, keeping the first `used_bytes`.
  [[nodiscard]] bool grow(std::size_t bytes, std::size_t used_bytes) noexcept;
  void release() noexcept;

  template <class T>
  [[nodiscard]] T* as() const noexcept {
    return static_cast<T*>(memory_);
  }
  [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }

 private:
  void* memory_ = nullptr;
  std::size_t bytes_ = 0;
};

/// Memory held by all of them.
template <class... Memories>
[[nodiscard]] std::size_t bytes_of(const Memories&... memories) noexcept {
  return (memories.bytes() + ...);
}

/// Memory as a buffer's for std::vector, so that random access over it meets large pages.
template <class T>
struct LargeAllocator {
  using value_type = T;

  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) noexcept {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] T* allocate(std::size_t count) {
    void* const memory = count > static_cast<std::size_t>(-1) / 4 / sizeof(T)
                             ? nullptr
                             : allocate_large(count * sizeof(T));
    if (memory == nullptr) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) noexcept {
    deallocate_large(memory, count * sizeof(T));
  }
  friend bool operator==(const LargeAllocator&, const LargeAllocator&) noexcept { return true; }
};

}  // namespace harpoon
