#pragma once

// What a file is that should have been a text: told by its first bytes, so that a message can name
// it. Guesses nothing about texts.

#include <string>
#include <string_view>

namespace harpoon::app {

/// "gzip data; decompress it first", or nothing for what may be a text in UTF-8. `beginning` are
/// the file's first bytes, the more the better.
std::string other_than_text(std::string_view beginning);

}  // namespace harpoon::app
