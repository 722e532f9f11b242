#pragma once

// The one place where text from outside (files, options, names) is made fit for a terminal and for
// one line: nothing in it can move a cursor, hide, turn the direction of writing or fill a screen.

#include <string>
#include <string_view>

namespace harpoon::app {

/// Characters of a value that a message shows, and of a whole message.
inline constexpr std::size_t kMostQuoted = 80;
inline constexpr std::size_t kMostShown = 1000;

/// `text` with control characters, bytes that are not UTF-8, and invisible characters as escapes
/// (\n, \x1b, \u202e); of more than `most` characters the first and the last, with "..." between.
std::string printable(std::string_view text, std::size_t most = kMostShown);

/// The same between double quotes, in which quotes and backslashes are escaped too.
std::string in_quotes(std::string_view text, std::size_t most = kMostQuoted);

}  // namespace harpoon::app
