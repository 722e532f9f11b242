#include "apps/exit_code.hpp"

namespace harpoon::app {

ExitCode exit_code_for(Errc code) {
  switch (code) {
    case Errc::invalid_argument:
    case Errc::batch_too_large:
    case Errc::unsupported:
      return ExitCode::usage;
    case Errc::out_of_memory:
    case Errc::device_unavailable:
    case Errc::device_timeout:
      return ExitCode::environment;
    case Errc::invalid_index:
    case Errc::capacity:
    case Errc::executor_failed:
    case Errc::device_fault:
      return ExitCode::failure;
  }
  return ExitCode::failure;
}

}  // namespace harpoon::app
