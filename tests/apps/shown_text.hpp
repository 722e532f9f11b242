#pragma once

// A judge of what goes to a terminal, which shares nothing with the code that it judges.

#include <string>

namespace harpoon::app {

/// One line without its end: ASCII from space to tilde, or whole characters of UTF-8 that are no
/// controls.
inline bool is_fit_for_a_terminal(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    if (lead < 0x20 || lead == 0x7F) return false;
    const std::size_t bytes = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    if (lead >= 0x80 && lead < 0xC2) return false;
    if (i + bytes > text.size()) return false;
    for (std::size_t k = 1; k < bytes; ++k) {
      if ((static_cast<unsigned char>(text[i + k]) & 0xC0) != 0x80) return false;
    }
    if (lead == 0xC2 && static_cast<unsigned char>(text[i + 1]) < 0xA0) return false;
    i += bytes;
  }
  return true;
}

}  // namespace harpoon::app
