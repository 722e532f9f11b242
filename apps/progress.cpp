#include "apps/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output.hpp"
#include "apps/signals.hpp"
#include "bench/timer.hpp"

namespace harpoon::app {
namespace {

constexpr double kRedrawS = 0.1;
constexpr const char* kWipe = "\r\x1b[K";

double now_s() {
  return bench::now_ns() * 1e-9;
}

}  // namespace

std::string progress_line(double share, double elapsed_s, const std::string& title) {
  constexpr int kWidth = 30;
  constexpr double kLeastShare = 0.02;
  share = std::clamp(share, 0.0, 1.0);
  const int full = static_cast<int>(std::floor(share * kWidth));
  std::string line =
      fmt::format("[{}{}] {:3.0f} %", std::string(static_cast<std::size_t>(full), '#'),
                  std::string(static_cast<std::size_t>(kWidth - full), '.'), 100 * share);
  if (share >= kLeastShare) {
    line += fmt::format("  {:.0f} s left", std::ceil(elapsed_s * (1 - share) / share));
  }
  return line + "  " + title;
}

Progress::Progress(const Terminal& terminal)
    : enabled_(terminal.shows_progress), start_s_(now_s()) {}

Progress::~Progress() {
  if (enabled_ && drawn_s_ >= 0) {
    remark(kWipe);
    note_progress(false);
  }
}

void Progress::show(double share, const std::string& title) {
  const double elapsed_s = now_s() - start_s_;
  if (!enabled_ || (drawn_s_ >= 0 && elapsed_s < drawn_s_ + kRedrawS)) {
    return;
  }
  drawn_s_ = elapsed_s;
  note_progress(true);
  note("{}{}", kWipe, progress_line(share, elapsed_s, title));
}

}  // namespace harpoon::app
