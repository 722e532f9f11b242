#include "apps/printable.hpp"

#include <fmt/format.h>

#include <vector>

namespace harpoon::app {
namespace {

/// A character: its code and bytes, or one byte that begins none.
struct Character {
  char32_t code = 0;
  std::size_t bytes = 1;
  bool is_valid = false;
};

/// The first character of a text that is not empty. Refuses what UTF-8 refuses: overlong forms,
/// surrogates, codes above U+10FFFF.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {};
  char32_t code = lead & (0x7FU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3FU);
  }
  const bool overlong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  if (overlong || surrogate || code > 0x10FFFF) return {};
  return {code, bytes, true};
}

/// Controls of both sets, separators of lines, and characters without a shape of their own: spaces
/// that look like others, marks of direction, byte order marks, tags.
bool is_plain(char32_t code) {
  if (code < 0x20 || (code >= 0x7F && code <= 0xA0) || code == 0xAD) return false;
  if (code >= 0x2000 && code <= 0x200F) return false;
  if (code >= 0x2028 && code <= 0x202F) return false;
  if (code >= 0x205F && code <= 0x206F) return false;
  if (code == 0x061C || code == 0x180E || code == 0x3000 || code == 0xFEFF) return false;
  return code < 0xE000 || (code >= 0xF900 && code < 0xFFF0) || (code >= 0x10000 && code < 0xE0000);
}

std::string shown(const Character& c, std::string_view bytes, bool as_quote) {
  if (!c.is_valid) return fmt::format("\\x{:02x}", static_cast<unsigned char>(bytes[0]));
  if (as_quote && (c.code == '"' || c.code == '\\')) return fmt::format("\\{}", bytes);
  if (is_plain(c.code)) return std::string(bytes);
  if (c.code == '\n') return "\\n";
  if (c.code == '\r') return "\\r";
  if (c.code == '\t') return "\\t";
  return c.code < 0x80 ? fmt::format("\\x{:02x}", static_cast<unsigned>(c.code))
                       : fmt::format("\\u{:04x}", static_cast<unsigned>(c.code));
}

/// Each character as it is shown.
std::vector<std::string> characters(std::string_view text, bool as_quote) {
  std::vector<std::string> all;
  while (!text.empty()) {
    const Character c = first_character(text);
    all.push_back(shown(c, text.substr(0, c.bytes), as_quote));
    text.remove_prefix(c.bytes);
  }
  return all;
}

std::string joined(const std::vector<std::string>& all, std::size_t begin, std::size_t end) {
  std::string text;
  for (std::size_t i = begin; i < end; ++i) text += all[i];
  return text;
}

std::string shortened(std::string_view text, std::size_t most, bool as_quote) {
  constexpr std::size_t kMostBytes = 4;  // of a character
  if (text.size() > 2 * kMostBytes * most) {
    // Neither end can need more than so many bytes.
    const std::vector<std::string> head = characters(text.substr(0, kMostBytes * most), as_quote);
    const std::vector<std::string> tail =
        characters(text.substr(text.size() - kMostBytes * most), as_quote);
    return joined(head, 0, most / 2) + "..." + joined(tail, tail.size() - most / 4, tail.size());
  }
  const std::vector<std::string> all = characters(text, as_quote);
  if (all.size() <= most) return joined(all, 0, all.size());
  return joined(all, 0, most / 2) + "..." + joined(all, all.size() - most / 4, all.size());
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  return shortened(text, most, false);
}

std::string in_quotes(std::string_view text, std::size_t most) {
  return '"' + shortened(text, most, true) + '"';
}

}  // namespace harpoon::app
