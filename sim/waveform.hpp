#pragma once

// A value-change dump (VCD) of the AFU's ports, one sample a cycle: what crosses the boundary, for
// any waveform viewer. The inside of the AFU is not in it.

#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

class Vharpoon_afu;

namespace harpoon::sim {

class Waveform {
 public:
  /// Returns false when the file cannot be written.
  bool open(const std::string& path, double clock_mhz);
  [[nodiscard]] bool is_open() const noexcept { return file_ != nullptr; }
  /// Records the ports as they stand before the rising edge of this cycle.
  void sample(std::uint64_t cycle, const Vharpoon_afu& top);

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  std::vector<std::uint64_t> last_;
  bool first_ = true;
  std::uint64_t period_ps_ = 0;
};

}  // namespace harpoon::sim
