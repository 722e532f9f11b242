#include "bench/ode/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace harpoon::bench {
namespace {

void count_flow(Census& census, Flow flow) {
  switch (flow) {
    case Flow::fake:
      ++census.fake;
      break;
    case Flow::grazing:
      ++census.grazing;
      break;
    case Flow::real:
      ++census.real;
      break;
  }
}

// Puts each odd sphere on its even neighbour; returns the couples.
std::vector<IndexPair> make_grazing(std::vector<Point>& positions) {
  std::vector<IndexPair> couples;
  for (std::uint32_t i = 0; i + 1 < positions.size(); i += 2) {
    positions[i + 1] = positions[i];
    couples.push_back({i, i + 1});
  }
  return couples;
}

class Recorder {
 public:
  Recorder(DiamondWorld& world, PairType type, std::size_t count) : world_(world), count_(count) {
    recording_.type = type;
    recording_.radius = world.parameters().radius;
    recording_.constructed = type == PairType::grazing;
    recording_.pairs.reserve(count);
  }

  [[nodiscard]] bool done() const { return recording_.pairs.size() >= count_; }

  /// Returns whether the step gave a pair.
  bool step() {
    std::vector<Point> positions = world_.positions();
    std::vector<IndexPair> found;
    world_.step([&](const Candidate& candidate) {
      count_flow(recording_.census, candidate.flow);
      if (!recording_.constructed && matches(recording_.type, candidate.flow)) {
        found.push_back(candidate.spheres);
      }
    });
    ++recording_.steps;
    if (recording_.constructed) {
      found = make_grazing(positions);
    }
    found.resize(std::min(found.size(), count_ - recording_.pairs.size()));
    if (found.empty()) {
      return false;
    }
    recording_.frames.push_back({std::move(positions), recording_.pairs.size(), found.size()});
    recording_.pairs.insert(recording_.pairs.end(), found.begin(), found.end());
    return true;
  }

  Recording take() { return std::move(recording_); }

 private:
  DiamondWorld& world_;
  std::size_t count_;
  Recording recording_;
};

}  // namespace

Result<Recording> record(const DiamondParameters& parameters, PairType type, std::size_t count,
                         const Interrupted& interrupted) {
  Result<std::unique_ptr<DiamondWorld>> world = DiamondWorld::create(parameters);
  if (!world) {
    return world.error();
  }
  Recorder recorder(**world, type, count);
  std::uint64_t barren_steps = 0;
  while (!recorder.done() && !must_stop(interrupted)) {
    barren_steps = recorder.step() ? 0 : barren_steps + 1;
    if (barren_steps == kMaxBarrenSteps) {
      return Error{Errc::invalid_argument,
                   fmt::format("This diamond gave no {} pair in {} steps. Use a larger hmax, a "
                               "smaller dsph or a larger force.",
                               to_string(type), kMaxBarrenSteps)};
    }
  }
  return recorder.take();
}

}  // namespace harpoon::bench
