#pragma once

// Scratch memory that grows and is kept. Allocation failure is a return value; contents are lost
// when it grows.

#include <cstddef>

namespace harpoon::scene {

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

}  // namespace harpoon::scene
