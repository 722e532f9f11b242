#pragma once

// Lifetime of the ODE library and ownership of its objects. The only place that starts and stops
// ODE.

#include <string>

struct dxWorld;
struct dxSpace;
struct dxGeom;
struct dxBody;
struct dxJointGroup;

namespace harpoon::bench {

/// Keeps ODE initialised while at least one of these lives; they may nest. Not thread-safe: ODE's
/// start-up is not.
class OdeRuntime {
 public:
  OdeRuntime();
  ~OdeRuntime();
  OdeRuntime(const OdeRuntime&) = delete;
  OdeRuntime& operator=(const OdeRuntime&) = delete;
};

/// Version and precision of the ODE in use, for example "0.16.2 (double)".
std::string ode_version();

}  // namespace harpoon::bench
