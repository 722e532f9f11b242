#include "bench/ode/runtime.hpp"

#include <ode/ode.h>

#include <cstring>

namespace harpoon::bench {

// dInitODE2 and dCloseODE count their calls.
OdeRuntime::OdeRuntime() {
  dInitODE2(0);
}
OdeRuntime::~OdeRuntime() {
  dCloseODE();
}

std::string ode_version() {
  const OdeRuntime runtime;
  const bool is_double = std::strstr(dGetConfiguration(), "ODE_double_precision") != nullptr;
  return std::string(HARPOON_ODE_VERSION) + (is_double ? " (double)" : " (single)");
}

}  // namespace harpoon::bench
