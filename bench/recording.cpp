#include "bench/recording.hpp"

namespace harpoon::bench {
namespace {

template <class Real>
SphereOf<Real> sphere_at(const Point& p, double radius) {
  return {static_cast<Real>(p[0]), static_cast<Real>(p[1]), static_cast<Real>(p[2]),
          static_cast<Real>(radius)};
}

}  // namespace

template <class Real>
std::vector<SpherePairOf<Real>> to_records(const Recording& recording, std::size_t count) {
  std::vector<SpherePairOf<Real>> records;
  records.reserve(count);
  for (const Frame& frame : recording.frames) {
    for (std::size_t i = 0; i < frame.pair_count && records.size() < count; ++i) {
      const IndexPair& pair = recording.pairs[frame.first_pair + i];
      records.push_back({sphere_at<Real>(frame.positions[pair.g1], recording.radius),
                         sphere_at<Real>(frame.positions[pair.g2], recording.radius)});
    }
  }
  const std::size_t distinct = records.size();
  while (distinct > 0 && records.size() < count) {
    records.push_back(records[records.size() - distinct]);
  }
  return records;
}

template std::vector<SpherePair> to_records<float>(const Recording&, std::size_t);
template std::vector<SpherePairF64> to_records<double>(const Recording&, std::size_t);

}  // namespace harpoon::bench
