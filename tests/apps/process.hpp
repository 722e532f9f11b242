#pragma once

// Runs the command as a user does: in a process, with pipes or with a terminal.

#include <functional>
#include <string>
#include <vector>

namespace harpoon::app {

struct Finished {
  int exit_code = -1;  ///< 128 + signal when a signal ended it
  std::string out;
  std::string err;
};

/// Variables to set ("NAME=value") or to remove ("NAME") in the environment of the process.
using Environment = std::vector<std::string>;

/// Makes this process the command; does not return.
[[noreturn]] void become_command(const std::vector<std::string>& arguments);

/// Standard output and error are pipes.
Finished run_piped(const std::vector<std::string>& arguments, const Environment& environment = {});

/// The same of a script of the shell, in which $HARPOON is the command.
Finished run_script(const std::string& script);

/// Standard output and error are one terminal; everything is in `out`. `on_output` (may be empty)
/// is called with all output so far and the process id, each time more has come.
Finished run_on_terminal(const std::vector<std::string>& arguments, const Environment& environment,
                         const std::function<void(const std::string&, int)>& on_output = {});

}  // namespace harpoon::app
