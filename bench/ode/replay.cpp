#include "bench/ode/replay.hpp"

#include <algorithm>
#include <cmath>

#include "bench/ode/geom_set.hpp"
#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

std::vector<SphereF64> spheres_of(const Recording& recording) {
  std::vector<SphereF64> spheres;
  if (!recording.frames.empty()) {
    for (const Point& p : recording.frames.front().positions) {
      spheres.push_back({p[0], p[1], p[2], recording.radius});
    }
  }
  return spheres;
}

class OdeReplay final : public Contestant {
 public:
  explicit OdeReplay(const Recording& recording)
      : recording_(recording),
        geoms_(spheres_of(recording)),
        timer_overhead_ns_(measure_timer_overhead_ns()) {}

  [[nodiscard]] const Label& label() const override { return label_; }

  Result<Turn> take_turn(std::size_t count) override {
    return take_samples(pass_ns(count, 1),
                        [&](std::uint64_t runs) { return runs_ns(count, runs); });
  }

 private:
  Result<double> runs_ns(std::size_t count, std::uint64_t runs) {
    if (count <= recording_.frames.front().pair_count) {
      // One step's pairs: the spheres stay where they are, so all runs fit between two readings of
      // the clock.
      return pass_ns(count, runs);
    }
    double total_ns = 0;
    for (std::uint64_t run = 0; run < runs; ++run) {
      total_ns += pass_ns(count, 1);
    }
    return total_ns;
  }

  // All frames until `count` pairs are done, each frame's pairs `repeats` times.
  double pass_ns(std::size_t count, std::uint64_t repeats) {
    double total_ns = 0;
    std::size_t done = 0;
    for (std::size_t f = 0; done < count; f = (f + 1) % recording_.frames.size()) {
      const Frame& frame = recording_.frames[f];
      const std::size_t n = std::min(frame.pair_count, count - done);
      const auto pairs = std::span(recording_.pairs).subspan(frame.first_pair, n);
      geoms_.move(frame.positions);
      const double start = now_ns();
      for (std::uint64_t i = 0; i < repeats; ++i) {
        collide_all(geoms_, pairs);
      }
      total_ns += std::max(0.0, now_ns() - start - timer_overhead_ns_);
      done += n;
    }
    return total_ns;
  }

  Label label_{"ode", "f64", 1, "geoms", false, 128};
  const Recording& recording_;
  GeomSet geoms_;
  double timer_overhead_ns_;
};

}  // namespace

std::unique_ptr<Contestant> make_ode_replay(const Recording& recording) {
  return std::make_unique<OdeReplay>(recording);
}

}  // namespace harpoon::bench
