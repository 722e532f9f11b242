#pragma once

// Takes all contestants through all counts, turn by turn: in every round each count is done by each
// contestant in order before anything is done again. A lasting disturbance of the machine then
// falls on all of them alike; a short one on a few samples, which medians and fastest times leave
// behind.

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "bench/contestant.hpp"
#include "bench/interrupt.hpp"
#include "bench/stats.hpp"

namespace harpoon::bench {

/// What one contestant did at one count.
struct Measurement {
  std::size_t count = 0;   ///< pairs in the batch
  Summary ns;              ///< of a batch, over the samples of all turns
  std::uint64_t runs = 0;  ///< of the batch, over all turns

  [[nodiscard]] double ns_per_pair() const { return ns.median / static_cast<double>(count); }
  [[nodiscard]] double fastest_ns_per_pair() const { return ns.min / static_cast<double>(count); }
};

struct Series {
  Label label;
  std::vector<Measurement> points;  ///< ascending counts
};

/// A modelled contestant is deterministic and slow to simulate: it takes part in the first round
/// only, of the counts above kFewModelledPairs it does only every kModelledStride-th and the last,
/// and it does no batch of more than kMostModelledPairs.
inline constexpr std::size_t kFewModelledPairs = 10000;
inline constexpr std::size_t kModelledStride = 10;
inline constexpr std::size_t kMostModelledPairs = 100000;

class RoundRobin {
 public:
  /// `counts` ascending and not empty. Contestants must outlive this.
  RoundRobin(std::span<const std::unique_ptr<Contestant>> contestants,
             std::vector<std::size_t> counts);

  using Tick = std::function<void()>;

  /// One round. `tick` (may be empty) is called after each count. Stops early when interrupted.
  /// Errors: the first one of a contestant; its name is in the message.
  Result<bool> round(const Tick& tick, const Interrupted& interrupted);

  [[nodiscard]] std::vector<Series> series() const;

 private:
  struct Samples {
    std::vector<double> ns;
    std::uint64_t runs = 0;
  };
  [[nodiscard]] bool takes_part(const Label& label, std::size_t count_index) const;

  std::span<const std::unique_ptr<Contestant>> contestants_;
  std::vector<std::size_t> counts_;
  std::vector<std::vector<Samples>> samples_;  // by contestant, then by count
  std::size_t rounds_ = 0;
};

}  // namespace harpoon::bench
