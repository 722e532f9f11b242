#pragma once

// How the command ends: documented exit codes, and the one exception that carries them to main.
// Inside apps/ a failure of a command is thrown; the library and bench/ never throw.

#include <stdexcept>
#include <string>

#include "harpoon/error.hpp"

namespace harpoon::app {

enum class ExitCode : int {
  ok = 0,
  failure = 1,      ///< the command ran and found something wrong: a mismatch, a missed target
  usage = 2,        ///< bad option, value or command
  environment = 3,  ///< a file, device, package or memory that is not there, or fails
  data = 4,         ///< a file whose content is malformed, or of another kind
  not_served = 5,   ///< `run --require`: no call of ODE arrived, or none could be served
};

class CommandError : public std::runtime_error {
 public:
  /// `message` names the option or file and the remedy.
  CommandError(ExitCode code, const std::string& message)
      : std::runtime_error(message), code_(code) {}

  [[nodiscard]] ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// The exit code that fits a library error.
ExitCode exit_code_for(Errc code);

/// The value, or a CommandError with the error's message.
template <class T>
T value_or_throw(Result<T>&& result) {
  if (!result) {
    throw CommandError(exit_code_for(result.error().code), result.error().message);
  }
  return std::move(result.value());
}

}  // namespace harpoon::app
