#pragma once

// The simulated AFU as a link: the Verilated RTL in this process, behind the memory and link model.
// Time advances only when the caller asks, so cycle counts are a function of the calls, the profile
// and the seed. Knows nothing of transactions.

#include <cstdint>
#include <memory>

#include "device/afu/link.hpp"
#include "faults.hpp"
#include "link_model.hpp"
#include "profile.hpp"
#include "waveform.hpp"

namespace harpoon::sim {

struct SimulationOptions {
  LinkProfile profile;
  LinkNoise noise = {};
  std::uint64_t memory_seed = 1;  ///< scatters the physical pages
  WaveformSink waveform = {};     ///< takes a VCD of the AFU's ports; empty: none
};

/// An AFU in simulation. Single-threaded, like every AfuLink.
class SimulatedLink final : public afu::AfuLink {
 public:
  /// Starts in reset state. Errors: invalid_argument (a number of the profile).
  static Result<std::unique_ptr<SimulatedLink>> create(const SimulationOptions& options);
  ~SimulatedLink() override;

  [[nodiscard]] const afu::LinkInfo& info() const noexcept override;
  void write_register(std::uint32_t offset, std::uint32_t value) override;
  std::uint32_t read_register(std::uint32_t offset) override;
  Result<afu::SharedMemory> allocate(std::uint64_t bytes) override;
  void release(const afu::SharedMemory& memory) noexcept override;
  void advance(std::uint64_t cycles) override;
  [[nodiscard]] std::uint64_t now() const noexcept override;
  void reset() override;

  /// The link model: faults are armed here, counters and breaches read.
  [[nodiscard]] LinkModel& model() noexcept;

 private:
  struct State;
  explicit SimulatedLink(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace harpoon::sim
