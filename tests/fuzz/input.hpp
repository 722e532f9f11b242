#pragma once

// What the fuzz targets share: reading an input, memory that ends exactly where it says, and a
// check that stops the fuzzer.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

/// Stops the fuzzer with the place and the condition; libFuzzer then keeps the input.
#define FUZZ_REQUIRE(condition)                                                      \
  do {                                                                               \
    if (!(condition)) {                                                              \
      std::fprintf(stderr, "%s:%d: not true: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                  \
    }                                                                                \
  } while (false)

namespace harpoon::fuzz {

/// The input, read from the front; zeros after its end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  template <class T>
  T take() {
    T value{};
    const std::size_t n = size_ < sizeof(T) ? size_ : sizeof(T);
    if (n != 0) std::memcpy(&value, data_, n);
    data_ += n;
    size_ -= n;
    return value;
  }
  [[nodiscard]] std::size_t left() const { return size_; }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

/// `count` records that start `offset` bytes after an address that suits any type and end where the
/// allocation ends, so that the address sanitizer sees the first byte beyond. Filled with a pattern
/// that `untouched_from` looks for.
template <class T>
class Buffer {
 public:
  Buffer(std::size_t count, std::size_t offset)
      : count_(count), offset_(offset), bytes_(new std::byte[offset + count * sizeof(T)]) {
    std::memset(bytes_.get(), static_cast<int>(kPattern), offset + count * sizeof(T));
  }

  [[nodiscard]] T* data() { return reinterpret_cast<T*>(at(0)); }
  [[nodiscard]] std::size_t size() const { return count_; }
  void set(std::size_t i, const T& value) { std::memcpy(at(i), &value, sizeof(T)); }
  [[nodiscard]] T get(std::size_t i) const {
    T value;
    std::memcpy(&value, at(i), sizeof(T));
    return value;
  }
  /// Nothing was written to records [first, size).
  [[nodiscard]] bool untouched_from(std::size_t first) const {
    for (const std::byte* b = at(first); b < at(count_); ++b) {
      if (*b != kPattern) return false;
    }
    return true;
  }

 private:
  static constexpr std::byte kPattern{0xCB};

  [[nodiscard]] std::byte* at(std::size_t i) const {
    return bytes_.get() + offset_ + i * sizeof(T);
  }

  std::size_t count_;
  std::size_t offset_;
  std::unique_ptr<std::byte[]> bytes_;
};

}  // namespace harpoon::fuzz
