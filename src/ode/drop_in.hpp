#pragma once

// The services that libharpoon_ode_engine gives: for each libode an engine of its own, made at the
// first use and never destroyed, because programs use libode until their very end. Options come
// from the environment.

#include "harpoon/export.hpp"
#include "ode/service.hpp"

extern "C" {
/// `kServeSymbol`.
HARPOON_API harpoon::ode::Service* harpoon_ode_serve(const harpoon::ode::ServiceRequest& request);
}
