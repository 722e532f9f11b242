#include "ode/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <unordered_map>

namespace harpoon::ode {
namespace {

std::string_view kind_name(int kind) {
  switch (kind) {
    case geom_class::kSimpleSpace:
      return "simple";
    case geom_class::kHashSpace:
      return "hash";
    case geom_class::kSapSpace:
      return "SAP";
    default:
      return "quadtree";
  }
}

template <class Real>
std::string describe(const LibodeOf<Real>& ode, dxGeom* geom) {
  BoundsBox<Real> box;
  ode.geom_get_aabb(geom, box.v);
  return fmt::format("{} (class {}, x {} to {}, y {} to {}, z {} to {})", fmt::ptr(geom),
                     ode.geom_get_class(geom), box.v[0], box.v[1], box.v[2], box.v[3], box.v[4],
                     box.v[5]);
}

template <class Real>
std::string describe(const LibodeOf<Real>& ode, const GeomPair* pair) {
  if (pair == nullptr) return "nothing";
  return fmt::format("{} and {}", describe(ode, pair->o1), describe(ode, pair->o2));
}

template <class Real>
std::string describe(const ContactGeomOf<Real>* contact) {
  if (contact == nullptr) return "no contact";
  const ContactGeomOf<Real>& c = *contact;
  return fmt::format("pos {} {} {}, normal {} {} {}, depth {}", c.pos[0], c.pos[1], c.pos[2],
                     c.normal[0], c.normal[1], c.normal[2], c.depth);
}

}  // namespace

template <class Real>
void Verifier<Real>::abandon() {
  ended_ = true;
  walk_.abandon();
}

template <class Real>
void Verifier<Real>::compare(const GeomPair* ours) {
  if (ended_) return;
  try {
    GeomPair pair;
    const GeomPair* const stock = walk_.next(pair) ? &pair : nullptr;
    const bool same = ours == nullptr ? stock == nullptr : stock != nullptr && *ours == *stock;
    if (!same) return report(ours, stock);
    if (stock != nullptr) {
      ++compared_;
      seen_.push_back(pair);
    }
  } catch (const std::bad_alloc&) {
    // The program goes on; this call stays unverified from here on.
    ended_ = true;
  }
}

template <class Real>
void Verifier<Real>::report(const GeomPair* ours, const GeomPair* stock) {
  ended_ = true;
  const SpaceRecord<Real>& record = call_.record;
  const std::string difference =
      fmt::format("{}, call {} on {} space {} with {} geoms: pair number {} is {}; stock has {}",
                  call_.name, record.calls, kind_name(record.kind), fmt::ptr(record.space),
                  record.mirror.size(), seen_.size(), describe(ode_, ours), describe(ode_, stock));
  if (!call_.can_be_repeated) return differs_(difference, nullptr);
  GeomPair pair;
  if (stock != nullptr) seen_.push_back(*stock);
  while (walk_.next(pair)) seen_.push_back(pair);
  CollisionFrame frame = frame_of<Real>(ode_, record, call_.policy, seen_);
  frame.difference = difference;
  differs_(difference, &frame);
}

template <class Real>
CollisionFrame frame_of(const LibodeOf<Real>& ode, const SpaceRecord<Real>& record, Policy policy,
                        std::span<const GeomPair> stock) {
  const Mirror<Real>& mirror = record.mirror;
  CollisionFrame frame;
  frame.single_precision = sizeof(Real) == sizeof(float);
  frame.policy = policy;
  frame.kind = record.kind;
  if (record.kind == geom_class::kHashSpace) {
    ode.hash_space_get_levels(record.space, &frame.min_level, &frame.max_level);
  }
  if (record.sap) frame.axis_order = record.sap->axis_order();
  std::unordered_map<const dxBody*, std::uint32_t> bodies = {{nullptr, 0}};
  std::unordered_map<const dxGeom*, std::uint32_t> geoms;
  for (std::uint32_t i = 0; i < mirror.size(); ++i) {
    geoms.emplace(mirror.geoms[i], i);
    const auto body = static_cast<std::uint32_t>(bodies.size());
    FrameGeom geom;
    geom.class_number = ode.geom_get_class(mirror.geoms[i]);
    geom.body = bodies.try_emplace(mirror.bodies[i], body).first->second;
    geom.category = mirror.category[i];
    geom.collide = mirror.collide[i];
    std::copy_n(mirror.bounds[i].v, 6, geom.bounds);
    frame.geoms.push_back(geom);
  }
  frame.ours = record.pairs;
  for (const auto& [o1, o2] : stock) {
    const auto first = geoms.find(o1), second = geoms.find(o2);
    // A geom that the mirror does not have cannot be named: the rest of stock's pairs tell enough.
    if (first != geoms.end() && second != geoms.end()) {
      frame.stock.push_back({first->second, second->second});
    }
  }
  return frame;
}

template <class Real>
std::optional<std::string> compare_contacts(const LibodeOf<Real>& ode, GeomPair pair,
                                            const ContactGeomOf<Real>* ours,
                                            const ContactGeomOf<Real>* stock) {
  const auto same = [](const auto& a, const auto& b, std::size_t bytes) {
    return std::memcmp(&a, &b, bytes) == 0;
  };
  constexpr std::size_t kVectorBytes = 3 * sizeof(Real);
  if (ours == nullptr && stock == nullptr) return std::nullopt;
  if (ours != nullptr && stock != nullptr && same(ours->pos, stock->pos, kVectorBytes) &&
      same(ours->normal, stock->normal, kVectorBytes) &&
      same(ours->depth, stock->depth, sizeof(Real)) && ours->g1 == stock->g1 &&
      ours->g2 == stock->g2 && ours->side1 == stock->side1 && ours->side2 == stock->side2) {
    return std::nullopt;
  }
  return fmt::format("contact of {} and {}: {}; stock has {}", describe(ode, pair.o1),
                     describe(ode, pair.o2), describe(ours), describe(stock));
}

template class Verifier<float>;
template class Verifier<double>;
template CollisionFrame frame_of(const LibodeOf<float>&, const SpaceRecord<float>&, Policy,
                                 std::span<const GeomPair>);
template CollisionFrame frame_of(const LibodeOf<double>&, const SpaceRecord<double>&, Policy,
                                 std::span<const GeomPair>);
template std::optional<std::string> compare_contacts(const LibodeOf<float>&, GeomPair,
                                                     const ContactGeomOf<float>*,
                                                     const ContactGeomOf<float>*);
template std::optional<std::string> compare_contacts(const LibodeOf<double>&, GeomPair,
                                                     const ContactGeomOf<double>*,
                                                     const ContactGeomOf<double>*);

}  // namespace harpoon::ode
