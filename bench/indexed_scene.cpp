#include "bench/indexed_scene.hpp"

#include <random>

#include "bench/algorithm1.hpp"

namespace harpoon::bench {
namespace {

constexpr double kRadius = 0.1;

// Side of the cube of sphere centres.
double side_for(PairType type) {
  switch (type) {
    case PairType::fake:
      return 1e5;  // far too thin for any two to meet
    case PairType::grazing:
      return 0;
    case PairType::real:
      return 0.11;  // its diagonal is below two radii
    case PairType::mixed:
      return 0.305;  // found by bisection: half of the pairs overlap
  }
  return 0;
}

// std::uniform_*_distribution differs between libraries; these do not.
double uniform(std::mt19937_64& engine) {
  return static_cast<double>(engine() >> 11) * 0x1p-53;
}
std::uint32_t below(std::mt19937_64& engine, std::size_t n) {
  return static_cast<std::uint32_t>(engine() % n);
}

}  // namespace

IndexedScene make_indexed_scene(PairType type, std::size_t sphere_count, std::size_t pair_count,
                                std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  IndexedScene scene{type, seed, {}, {}, 0};
  const double side = side_for(type);
  scene.spheres.reserve(sphere_count);
  for (std::size_t i = 0; i < sphere_count; ++i) {
    const double x = side * uniform(engine);
    const double y = side * uniform(engine);
    const double z = side * uniform(engine);
    scene.spheres.push_back({x, y, z, kRadius});
  }
  std::size_t hits = 0;
  scene.pairs.reserve(pair_count);
  while (scene.pairs.size() < pair_count) {
    const IndexPair pair{below(engine, sphere_count), below(engine, sphere_count)};
    if (pair.g1 == pair.g2) {
      continue;
    }
    scene.pairs.push_back(pair);
    const SpherePairF64 spheres{scene.spheres[pair.g1], scene.spheres[pair.g2]};
    hits += algorithm1(spheres).hit() ? 1 : 0;
  }
  if (pair_count > 0) {
    scene.hit_share = static_cast<double>(hits) / static_cast<double>(pair_count);
  }
  return scene;
}

template <class Real>
std::vector<SphereOf<Real>> convert(const std::vector<SphereF64>& spheres) {
  std::vector<SphereOf<Real>> converted;
  converted.reserve(spheres.size());
  for (const SphereF64& s : spheres) {
    converted.push_back({static_cast<Real>(s.x), static_cast<Real>(s.y), static_cast<Real>(s.z),
                         static_cast<Real>(s.r)});
  }
  return converted;
}

template std::vector<Sphere> convert<float>(const std::vector<SphereF64>&);
template std::vector<SphereF64> convert<double>(const std::vector<SphereF64>&);

}  // namespace harpoon::bench
