#include "apps/detect/text_source.hpp"

#include <algorithm>
#include <cstring>

namespace harpoon::app {

TextSource::TextSource(ReadBytes read, std::uint64_t bytes, ReadProgress progress)
    : read_(std::move(read)),
      bytes_(bytes),
      progress_(std::move(progress)),
      buffer_(kLookAheadBytes) {}

/// Makes room behind what is left and reads into it. False when nothing more comes.
bool TextSource::refill() {
  if (is_at_end_) return false;
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  const std::size_t got = read_(std::span(buffer_).subspan(end_));
  is_at_end_ = got == 0;
  end_ += got;
  bytes_read_ += got;
  if (progress_ && bytes_ != 0 && got != 0) {
    progress_(std::min(1.0, static_cast<double>(bytes_read_) / static_cast<double>(bytes_)));
  }
  return got != 0;
}

std::string_view TextSource::look_ahead() {
  while (end_ < buffer_.size() && refill()) continue;
  return {buffer_.data() + begin_, end_ - begin_};
}

void TextSource::skip(std::size_t bytes) {
  begin_ += bytes;
}

TextSource::Line TextSource::next_line(std::string_view& line) {
  std::size_t looked_at = 0;
  while (true) {
    const std::size_t left = end_ - begin_;
    const void* const found =
        left > looked_at ? std::memchr(buffer_.data() + begin_ + looked_at, '\n', left - looked_at)
                         : nullptr;
    const std::size_t length =
        found == nullptr
            ? left
            : static_cast<std::size_t>(static_cast<const char*>(found) - buffer_.data()) - begin_;
    if (found == nullptr && length <= kMostLineBytes && refill()) {
      looked_at = left;
      continue;
    }
    if (found == nullptr && left == 0) return Line::none;
    last_line_ = line_++;
    if (length > kMostLineBytes) return Line::too_long;
    line = {buffer_.data() + begin_, length};
    begin_ += length + (found == nullptr ? 0 : 1);
    return Line::there;
  }
}

}  // namespace harpoon::app
