#pragma once

// libharpoon_ode as a file, and programs run with it in front of libode: instead of this process,
// or watched by it where silence could be taken for success.

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

/// What `run_and_watch` looks for at the end.
struct Watched {
  bool require = false;  ///< that a call of ODE was served: otherwise `ExitCode::not_served`
};

/// Runs `command` in the same way, in a process of its own, passes signals on to it, and says so on
/// standard error when it has ended and no call of ODE arrived in it or in those that it started.
/// Ends this process as that one ended. Returns only by throwing CommandError: the command is not
/// there (environment), or what is required did not happen (not_served).
[[noreturn]] void run_and_watch(const std::vector<std::string>& command,
                                const std::vector<Variable>& variables, Watched watched);

/// Replaces this process by `command` with the library preloaded and the variables set. Returns
/// only by throwing CommandError: the command is not there (environment).
[[noreturn]] void run_with_drop_in(const std::vector<std::string>& command,
                                   const std::vector<Variable>& variables);

}  // namespace harpoon::app
