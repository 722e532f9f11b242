#pragma once

// The manual page harpoon(1).

#include <string>

#include "apps/command_tree.hpp"

namespace harpoon::app {

/// In roff with the man macros. `version` is shown in the footer.
std::string manual_page(const CommandInfo& root, const std::string& version);

/// `text` so that roff prints it as it is.
std::string roff_escaped(const std::string& text);

}  // namespace harpoon::app
