#pragma once

// How busy the machine was with other things while something was measured: what a reader of figures
// from a shared machine must know. It judges nothing.

#include <cstdint>
#include <optional>
#include <string>

namespace harpoon::bench {

struct MachineLoad {
  /// The kernel's load average over a minute when the measurement began and when it ended;
  /// negative where the kernel tells none.
  double before = -1;
  double after = -1;
  /// Share of the measurement, 0 to 1, in which some task of the machine had to wait for a
  /// processor (the kernel's pressure-stall information). Nothing where the kernel tells none.
  std::optional<double> waiting;

  /// Others were in the way for so much of the time that slow samples are theirs.
  [[nodiscard]] bool busy() const;
};

/// Watches from its making on.
class LoadWatch {
 public:
  LoadWatch();
  [[nodiscard]] MachineLoad look() const;

 private:
  double before_;
  double start_ns_;
  std::optional<std::uint64_t> waited_us_;
};

/// A sentence for people.
std::string describe_load(const MachineLoad& load);

}  // namespace harpoon::bench
