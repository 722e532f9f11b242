#pragma once

// A value-change dump (VCD) of the AFU's ports, one sample a cycle: what crosses the boundary, for
// any waveform viewer. The inside of the AFU is not in it. Where the text goes is the caller's:
// files are not opened here.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

class Vharpoon_afu;

namespace harpoon::sim {

/// Takes the text piece by piece. Must not throw: it is called from inside a simulated cycle.
using WaveformSink = std::function<void(std::string_view)>;

class Waveform {
 public:
  Waveform() = default;
  /// Gives the sink what is left.
  ~Waveform();
  Waveform(const Waveform&) = delete;
  Waveform& operator=(const Waveform&) = delete;

  void open(WaveformSink sink, double clock_mhz);
  [[nodiscard]] bool is_open() const noexcept { return static_cast<bool>(sink_); }
  /// Records the ports as they stand before the rising edge of this cycle.
  void sample(std::uint64_t cycle, const Vharpoon_afu& top);

 private:
  WaveformSink sink_;
  std::string text_;
  std::vector<std::uint64_t> last_;
  bool first_ = true;
  std::uint64_t period_ps_ = 0;
};

}  // namespace harpoon::sim
