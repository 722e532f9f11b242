#pragma once

// libharpoon_ode as a file, and programs run with it in front of libode.

#include <filesystem>
#include <string>
#include <vector>

namespace harpoon::app {

/// The library beside this command: in its build folder or where it is installed. Throws
/// CommandError (environment) when it is not there.
std::filesystem::path find_drop_in();

/// One variable of the environment.
struct Variable {
  std::string name, value;
};

/// Replaces this process by `command` with the library preloaded and the variables set. Returns
/// only by throwing CommandError: the command is not there (environment).
[[noreturn]] void run_with_drop_in(const std::vector<std::string>& command,
                                   const std::vector<Variable>& variables);

}  // namespace harpoon::app
