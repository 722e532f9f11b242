#pragma once

// Whether this build of libode tells of the changes that programs make. One that calls its own
// functions directly, as some linkers and compilers see to, changes geoms without a word. Found out
// by making each kind of change in spaces of our own, before the first call is answered. What the
// program has made is neither looked at nor changed.

#include <string>

#include "ode/guarded_service.hpp"
#include "ode/service.hpp"

namespace harpoon::ode {

/// The first change that nobody tells of, as its function's name; empty: all are told. Events of
/// other threads meanwhile get lost, so no engine may have any use for them yet. The service hears
/// of events from then on.
template <class Real>
std::string unheard_change(const ServiceRequest& request, GuardedService<Real>& service);

}  // namespace harpoon::ode
