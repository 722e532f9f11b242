#include "bench/round_robin.hpp"

#include <fmt/format.h>

namespace harpoon::bench {

RoundRobin::RoundRobin(std::span<const std::unique_ptr<Contestant>> contestants,
                       std::vector<std::size_t> counts)
    : contestants_(contestants),
      counts_(std::move(counts)),
      samples_(contestants.size(), std::vector<Samples>(counts_.size())) {}

bool RoundRobin::takes_part(const Label& label, std::size_t count_index) const {
  if (!label.modelled) {
    return true;
  }
  const bool is_last = count_index + 1 == counts_.size();
  const std::size_t count = counts_[count_index];
  return rounds_ == 0 && count <= kMostModelledPairs &&
         (is_last || count <= kFewModelledPairs || count_index % kModelledStride == 0);
}

Result<bool> RoundRobin::round(const Tick& tick, const Interrupted& interrupted) {
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    for (std::size_t c = 0; c < contestants_.size(); ++c) {
      if (must_stop(interrupted)) {
        return false;
      }
      Contestant& contestant = *contestants_[c];
      if (!takes_part(contestant.label(), i)) {
        continue;
      }
      const Result<Turn> turn = contestant.take_turn(counts_[i]);
      if (!turn) {
        const Error& error = turn.error();
        return Error{error.code,
                     fmt::format("Device {} ({}, {} pairs): {}", contestant.label().device,
                                 contestant.label().precision, counts_[i], error.message),
                     error.needed};
      }
      std::vector<double>& samples = samples_[c][i].ns;
      samples.insert(samples.end(), turn->samples_ns.begin(), turn->samples_ns.end());
      samples_[c][i].runs += turn->runs;
    }
    if (tick) {
      tick();
    }
  }
  ++rounds_;
  return true;
}

std::vector<Series> RoundRobin::series() const {
  std::vector<Series> all;
  for (std::size_t c = 0; c < contestants_.size(); ++c) {
    Series series{contestants_[c]->label(), {}};
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      const Samples& samples = samples_[c][i];
      if (!samples.ns.empty()) {
        series.points.push_back({counts_[i], summarize(samples.ns), samples.runs});
      }
    }
    all.push_back(std::move(series));
  }
  return all;
}

}  // namespace harpoon::bench
