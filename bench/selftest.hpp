#pragma once

// Is this machine's every device right? Each is asked hard pairs in every form and precision it
// does, and its contacts are compared bit by bit with plain Algorithm 1 and, where there is one,
// with a second oracle (stock dCollide). It measures no time.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/device_contestant.hpp"
#include "bench/interrupt.hpp"
#include "harpoon/device.hpp"

namespace harpoon::bench {

/// An independent answer for a pair whose numbers are finite and whose radii are not negative.
struct Oracle {
  std::string name;
  std::function<ContactF64(const SpherePairF64&)> collide;
};

struct SelftestPlan {
  std::vector<NamedDevice> devices;
  std::vector<Oracle> oracles;  ///< beside plain Algorithm 1
  std::uint64_t seed = 1;
  std::size_t pairs = 1000000;        ///< for each check
  std::size_t modelled_pairs = 2000;  ///< the same for simulated devices, which are slow
};

/// One device against one oracle in one form and precision.
struct SelftestCheck {
  std::string device;
  std::string form;     ///< "records", "arrays", "indexed"
  std::string against;  ///< "f32 = Algorithm 1"
  std::uint64_t pairs = 0;
  std::uint64_t mismatches = 0;
  std::string first_mismatch;  ///< the pair, the contact and the contact expected; or the error

  [[nodiscard]] bool passed() const { return mismatches == 0 && first_mismatch.empty(); }
};

/// Called after every check.
using OnCheck = std::function<void(const SelftestCheck&)>;

/// Equal bits in every word; any NaN equals any NaN.
template <class Real>
bool same_bits(const ContactOf<Real>& a, const ContactOf<Real>& b);

/// One device on given pairs as records, against plain Algorithm 1.
template <class Real>
SelftestCheck check_records(const NamedDevice& device, std::vector<SpherePairOf<Real>> pairs);

/// Runs all checks in order; stops between two when interrupted.
std::vector<SelftestCheck> run_selftest(const SelftestPlan& plan, const OnCheck& on_check = {},
                                        const Interrupted& interrupted = {});

}  // namespace harpoon::bench
