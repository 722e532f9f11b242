#pragma once

// A line of 64 bytes as host and simulator handle it: fields, check word, digest, all as defined in
// contract.hpp. Little-endian hosts only.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "device/afu/contract.hpp"

namespace harpoon::afu {

static_assert(std::endian::native == std::endian::little);

struct Line {
  std::array<std::uint64_t, contract::kWordsPerLine> words{};

  [[nodiscard]] std::uint64_t get(const contract::Field& field) const noexcept {
    std::uint64_t value = 0;
    std::memcpy(&value, reinterpret_cast<const std::byte*>(words.data()) + field.offset,
                field.bytes);
    return value;
  }
  [[nodiscard]] std::uint32_t get32(const contract::Field& field) const noexcept {
    return static_cast<std::uint32_t>(get(field));
  }
  void put(const contract::Field& field, std::uint64_t value) noexcept {
    std::memcpy(reinterpret_cast<std::byte*>(words.data()) + field.offset, &value, field.bytes);
  }

  /// contract: line_fold.
  [[nodiscard]] std::uint64_t fold() const noexcept {
    std::uint64_t fold = 0;
    for (std::size_t i = 0; i < words.size(); ++i) {
      const std::uint64_t w = words[i];
      fold ^= w ^ std::rotl(w, static_cast<int>(contract::kFoldB[i])) ^
              std::rotl(w, static_cast<int>(contract::kFoldC[i]));
    }
    return fold;
  }
  /// What the check word of this line must be.
  [[nodiscard]] std::uint64_t expected_check() const noexcept {
    Line body = *this;
    body.words.back() = 0;
    return contract::kCheckSeed ^ body.fold();
  }
  [[nodiscard]] bool check_matches() const noexcept { return words.back() == expected_check(); }
  void seal() noexcept { words.back() = expected_check(); }
};
static_assert(sizeof(Line) == contract::kLineBytes);

inline Line load_line(const std::byte* from) noexcept {
  Line line;
  std::memcpy(&line, from, sizeof line);
  return line;
}
inline void store_line(std::byte* to, const Line& line) noexcept {
  std::memcpy(to, &line, sizeof line);
}

/// The digest of a sequence of lines: d = rotl(d, 1) + line_fold(line).
class Digest {
 public:
  void add(const Line& line) noexcept { value_ = std::rotl(value_, 1) + line.fold(); }
  /// `bytes` is a multiple of the line.
  void add(const std::byte* lines, std::uint64_t bytes) noexcept {
    for (std::uint64_t at = 0; at < bytes; at += contract::kLineBytes) add(load_line(lines + at));
  }
  [[nodiscard]] std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0;
};

}  // namespace harpoon::afu
