#include "harpoon/error.hpp"

namespace harpoon {

std::string_view to_string(Errc code) noexcept {
  switch (code) {
    case Errc::invalid_argument:
      return "invalid_argument";
    case Errc::invalid_index:
      return "invalid_index";
    case Errc::capacity:
      return "capacity";
    case Errc::batch_too_large:
      return "batch_too_large";
    case Errc::out_of_memory:
      return "out_of_memory";
    case Errc::executor_failed:
      return "executor_failed";
    case Errc::unsupported:
      return "unsupported";
    case Errc::device_unavailable:
      return "device_unavailable";
    case Errc::device_timeout:
      return "device_timeout";
    case Errc::device_fault:
      return "device_fault";
  }
  return "unknown";
}

}  // namespace harpoon
