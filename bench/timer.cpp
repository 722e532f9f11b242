#include "bench/timer.hpp"

#include <vector>

#include "bench/stats.hpp"

namespace harpoon::bench {

double measure_timer_overhead_ns() {
  // The clock ticks in whole nanoseconds, so one interval is too coarse: a sample is the mean of a
  // run of back-to-back intervals.
  constexpr int kIntervalsPerSample = 100;
  constexpr int kSamples = 201;
  std::vector<double> samples;
  samples.reserve(kSamples);
  for (int s = 0; s < kSamples; ++s) {
    double sum = 0;
    for (int i = 0; i < kIntervalsPerSample; ++i) {
      const double start = now_ns();
      sum += now_ns() - start;
    }
    samples.push_back(sum / kIntervalsPerSample);
  }
  return summarize(samples).median;
}

}  // namespace harpoon::bench
