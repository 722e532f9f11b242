#include "ode/geom_layout.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <optional>

namespace harpoon::ode {
namespace {

/// Objects are larger than what is looked for in them; the search ends where it is found.
constexpr std::uint16_t kMostBytes = 256;
constexpr unsigned long kSomeBits = 0x5A17C0DE, kOtherBits = 0x3C0FFEE1;

/// Offsets are looked for in steps of the value's size, behind the pointer to virtual functions.
template <class Value, class Expected>
std::optional<std::uint16_t> find(const dxGeom* geom, const Expected& expected) {
  for (std::uint16_t offset = sizeof(std::uintptr_t); offset < kMostBytes;
       offset += sizeof(Value)) {
    if (GeomLayout::at<Value>(geom, offset) == expected) return offset;
  }
  return std::nullopt;
}

/// The one bit in which two words differ, or 0.
std::int32_t single_bit(std::int32_t a, std::int32_t b) {
  const auto difference = static_cast<std::uint32_t>(a ^ b);
  return std::has_single_bit(difference) ? a ^ b : 0;
}

/// Geoms to look at, gone afterwards.
template <class Real>
struct Specimens {
  explicit Specimens(const LibodeOf<Real>& the_ode)
      : ode(the_ode),
        space(ode.simple_space_create(nullptr)),
        world(ode.world_create()),
        body(ode.body_create(world)),
        sphere(ode.create_sphere(space, kRadius)),
        point(ode.create_sphere(space, Real(0))),
        offset_sphere(ode.create_sphere(space, kRadius)) {
    ode.geom_set_position(sphere, Real(11.25), Real(-7.5), Real(3.125));
    ode.geom_set_category_bits(sphere, kSomeBits);
    ode.geom_set_collide_bits(sphere, kOtherBits);
    ode.geom_set_body(offset_sphere, body);
    ode.geom_set_offset_position(offset_sphere, Real(1), Real(2), Real(3));
  }
  ~Specimens() {
    ode.geom_destroy(as_geom(space));
    ode.world_destroy(world);
  }
  Specimens(const Specimens&) = delete;
  Specimens& operator=(const Specimens&) = delete;

  static constexpr Real kRadius = Real(0.8125);
  const LibodeOf<Real>& ode;
  dxSpace* const space;
  dxWorld* const world;
  dxBody* const body;
  dxGeom *const sphere, *const point, *const offset_sphere;
};

template <class Real>
bool are_same(const BoundsBox<Real>& a, const BoundsBox<Real>& b) {
  return std::equal(std::begin(a.v), std::end(a.v), std::begin(b.v));
}

/// The first offset of six numbers that are the geom's bounds.
template <class Real>
std::optional<std::uint16_t> find_bounds(const LibodeOf<Real>& ode, dxGeom* geom) {
  BoundsBox<Real> box;
  ode.geom_get_aabb(geom, box.v);
  for (std::uint16_t offset = sizeof(std::uintptr_t); offset < kMostBytes; offset += sizeof(Real)) {
    if (GeomLayout::at<Real>(geom, offset) != box.v[0]) continue;
    const auto found = GeomLayout::at<BoundsBox<Real>>(geom, offset);
    if (are_same(found, box)) return offset;
  }
  return std::nullopt;
}

template <class Real>
bool find_offsets(const Specimens<Real>& all, GeomLayout& layout) {
  const auto take = [](std::uint16_t& offset, std::optional<std::uint16_t> found) {
    offset = found.value_or(0);
    return found.has_value();
  };
  const dxGeom* const sphere = all.sphere;
  return take(layout.type, find<std::int32_t>(as_geom(all.space), geom_class::kSimpleSpace)) &&
         take(layout.body, find<const void*>(all.offset_sphere, all.body)) &&
         take(layout.pose, find<const Real*>(sphere, all.ode.geom_get_position(all.sphere))) &&
         take(layout.bounds, find_bounds(all.ode, all.sphere)) &&
         take(layout.category, find<unsigned long>(sphere, kSomeBits)) &&
         take(layout.collide, find<unsigned long>(sphere, kOtherBits)) &&
         take(layout.radius, find<Real>(sphere, Specimens<Real>::kRadius));
}

/// The flags are a word behind the type in which single bits change.
template <class Real>
bool find_flags(const Specimens<Real>& all, GeomLayout& layout) {
  layout.flags = static_cast<std::uint16_t>(layout.type + sizeof(std::int32_t));
  const auto flags = [&](const dxGeom* geom) {
    return GeomLayout::at<std::int32_t>(geom, layout.flags);
  };
  const std::int32_t fresh = flags(all.offset_sphere);
  (void)all.ode.geom_get_position(all.offset_sphere);
  layout.pose_bad = single_bit(fresh, flags(all.offset_sphere));

  const std::int32_t before = flags(all.sphere);
  all.ode.geom_disable(all.sphere);
  layout.enabled = single_bit(before, flags(all.sphere));
  all.ode.geom_enable(all.sphere);

  // With bounds that are computed, only what the space knows is left to change.
  BoundsBox<Real> box;
  for (dxGeom* const geom : {all.sphere, all.point}) all.ode.geom_get_aabb(geom, box.v);
  const std::int32_t moved = flags(all.sphere);
  layout.zero_sized = single_bit(moved, flags(all.point));
  all.ode.space_clean(all.space);
  layout.dirty = single_bit(moved, flags(all.sphere));
  return layout.pose_bad != 0 && layout.enabled != 0 && layout.zero_sized != 0 &&
         layout.dirty != 0 && (before & layout.enabled) != 0 && (moved & layout.dirty) != 0 &&
         (fresh & layout.pose_bad) != 0 && (moved & layout.zero_sized) == 0;
}

/// Looks once more, at other values.
template <class Real>
bool holds(const Specimens<Real>& all, const GeomLayout& layout) {
  const LibodeOf<Real>& ode = all.ode;
  ode.geom_set_category_bits(all.sphere, kOtherBits);
  ode.geom_set_collide_bits(all.sphere, kSomeBits);
  ode.geom_set_position(all.sphere, Real(-100), Real(50), Real(25));
  BoundsBox<Real> box;
  ode.geom_get_aabb(all.sphere, box.v);
  const auto found = GeomLayout::at<BoundsBox<Real>>(all.sphere, layout.bounds);
  const auto* const pose = GeomLayout::at<const Real*>(all.offset_sphere, layout.pose);
  return GeomLayout::at<std::int32_t>(all.sphere, layout.type) == geom_class::kSphere &&
         GeomLayout::at<const void*>(all.sphere, layout.body) == nullptr &&
         GeomLayout::at<unsigned long>(all.sphere, layout.category) == kOtherBits &&
         GeomLayout::at<unsigned long>(all.sphere, layout.collide) == kSomeBits &&
         GeomLayout::at<Real>(all.point, layout.radius) == 0 && are_same(found, box) &&
         pose == ode.geom_get_position(all.offset_sphere);
}

}  // namespace

template <class Real>
GeomLayout find_geom_layout(const LibodeOf<Real>& ode) {
  const Specimens<Real> all(ode);
  GeomLayout layout;
  layout.is_known = find_offsets(all, layout) && find_flags(all, layout) && holds(all, layout);
  return layout;
}

template GeomLayout find_geom_layout(const LibodeOf<float>&);
template GeomLayout find_geom_layout(const LibodeOf<double>&);

}  // namespace harpoon::ode
