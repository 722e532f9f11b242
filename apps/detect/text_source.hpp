#pragma once

// A text as it comes from a file, piece by piece: never more of it in memory than one buffer.
// Knows lines and places, and nothing of what is on them.

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace harpoon::app {

/// Gives the next bytes: how many of the buffer it filled, 0 at the end. May throw.
using ReadBytes = std::function<std::size_t(std::span<char>)>;
/// Called now and then with the part that has been read, 0 to 1.
using ReadProgress = std::function<void(double)>;

/// Bytes of a text that are in memory: what can be looked at before it is read.
inline constexpr std::size_t kLookAheadBytes = std::size_t{1} << 18;
/// Most bytes of a line, or of blanks where lines have no meaning.
inline constexpr std::size_t kMostLineBytes = std::size_t{1} << 16;
static_assert(kMostLineBytes < kLookAheadBytes);

class TextSource {
 public:
  /// `bytes` is the text's length if it is known, else 0: then there is no progress.
  TextSource(ReadBytes read, std::uint64_t bytes, ReadProgress progress);

  /// The first bytes of the text, at most `kLookAheadBytes`. Before anything is read.
  std::string_view look_ahead();
  /// Passes over so many bytes that are looked ahead at.
  void skip(std::size_t bytes);

  enum class Line : std::uint8_t { there, none, too_long };
  /// The next line without its end. `line` is valid until the next call.
  Line next_line(std::string_view& line);

  /// The next byte is there. False at the end of the text.
  bool has_next() { return begin_ < end_ || refill(); }
  /// The next byte, which is there.
  [[nodiscard]] const char& peek() const { return buffer_[begin_]; }
  void advance() {
    const bool ends_line = buffer_[begin_++] == '\n';
    last_line_ = line_;
    last_column_ = column_;
    line_ += ends_line ? 1 : 0;
    column_ = ends_line ? 1 : column_ + 1;
  }

  /// Place of the byte that was read last, by `advance`; or the number of the last line.
  [[nodiscard]] std::size_t line() const { return last_line_; }
  [[nodiscard]] std::size_t column() const { return last_column_; }

 private:
  bool refill();

  ReadBytes read_;
  std::uint64_t bytes_;
  ReadProgress progress_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;
  std::uint64_t bytes_read_ = 0;
  bool is_at_end_ = false;
  std::size_t line_ = 1, column_ = 1, last_line_ = 1, last_column_ = 1;
};

}  // namespace harpoon::app
