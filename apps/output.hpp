#pragma once

// The one writer of bytes. Whatever the command prints or writes goes through an Output, which
// looks at every result: a failure is a CommandError (environment) that names the place and the
// reason. What is a file and how it takes the place of an older one is files.hpp's.

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>

namespace harpoon::app {

/// Bytes on their way to a descriptor, which it does not own. Buffered; what is not flushed when it
/// ends is lost.
class Output {
 public:
  /// `name` stands in messages, `remedy` behind them.
  Output(int descriptor, std::string name, std::string remedy);

  void write(std::string_view bytes);
  template <class... Values>
  void print(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(fmt::appender(buffer_), format, std::forward<Values>(values)...);
    if (buffer_.size() >= kBufferBytes) flush();
  }
  void flush();

 private:
  static constexpr std::size_t kBufferBytes = std::size_t{1} << 16;

  int descriptor_;
  std::string name_, remedy_;
  fmt::basic_memory_buffer<char, 1024> buffer_;
};

/// What the command answers.
Output& standard_output();

template <class... Values>
void print(fmt::format_string<Values...> format, Values&&... values) {
  standard_output().print(format, std::forward<Values>(values)...);
}

/// A remark on standard error, at once, behind all that was printed before it. A remark that cannot
/// be written is not worth the work that it is about: the command goes on, and ends with exit
/// code 3.
void remark(std::string_view text);
template <class... Values>
void note(fmt::format_string<Values...> format, Values&&... values) {
  remark(fmt::format(format, std::forward<Values>(values)...));
}
[[nodiscard]] bool remarks_were_lost();

/// Makes sure that 0, 1 and 2 are open, so that no file of ours becomes one of them. A standard
/// output that was closed refuses what is written to it; remarks to a closed standard error vanish,
/// as their reader wished.
void open_standard_streams();

}  // namespace harpoon::app
