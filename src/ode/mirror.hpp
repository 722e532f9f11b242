#pragma once

// A packed copy of a space's enabled geoms in the space's own order: what finding and ordering
// pairs needs, without a walk through libode's objects. It is read anew when anything changed, or
// brought up to date when a few geoms moved; it never changes libode's state beyond what
// dSpaceClean does.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "harpoon/records.hpp"
#include "ode/bounds_box.hpp"
#include "ode/geom_reader.hpp"
#include "ode/libode.hpp"
#include "ode/packed_bounds.hpp"
#include "ode/slot_change.hpp"

namespace harpoon::ode {

inline constexpr std::size_t kCacheLineBytes = 64;

// Properties of a geom, as bits.
/// An entry of `spheres` that libode's own collider would read in the same way.
inline constexpr std::uint8_t kIsSphere = 1;
/// A bound is NaN.
inline constexpr std::uint8_t kIsNan = 2;
/// min > max on an axis.
inline constexpr std::uint8_t kIsInverted = 4;
/// A user class that wants to be asked about each pair.
inline constexpr std::uint8_t kHasAabbTest = 8;

template <class Real>
class Mirror {
 public:
  /// Cleans the space and reads all geoms of it that take part, `count` of them at most. Throws
  /// std::bad_alloc; the mirror is then empty.
  void read(const GeomReader<Real>& reader, dxSpace* space, int count);
  /// Brings the mirror of a simple or hash space up to date, of which nothing has changed since it
  /// was read but the bounds and poses of `moved` (ascending, none twice), and cleans the space.
  /// libode has put those first in its list. False when that is not what is found there, or when a
  /// bound was NaN or inverted: the mirror then has no meaning. O(moved + slots before the last of
  /// them). Throws std::bad_alloc; the same.
  [[nodiscard]] bool update_list(const GeomReader<Real>& reader, dxSpace* space,
                                 std::span<dxGeom* const> moved, SlotChange& change);
  /// The same for a SAP space, all of whose geoms must be enabled. libode puts its last geom in the
  /// place of one that moves, and the moved ones at the end.
  [[nodiscard]] bool update_array(const GeomReader<Real>& reader, dxSpace* space,
                                  std::span<dxGeom* const> moved, SlotChange& change);
  void clear();
  /// A geom is gone: its place holds null until the next reading.
  void forget(const dxGeom* geom) {
    std::replace(geoms.begin(), geoms.end(), const_cast<dxGeom*>(geom),
                 static_cast<dxGeom*>(nullptr));
  }
  /// Lets every pair pass libode's filters. Throws std::bad_alloc.
  void drop_filters();
  /// Adds a geom with what a replay of known pairs needs only: identity, sphere, whether it asks.
  void append_for_contacts(const GeomReader<Real>& reader, dxGeom* geom);

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(geoms.size()); }

  /// Whether libode's filters let the pair through: not on one body, category and collide bits.
  [[nodiscard]] bool counts(std::uint32_t i, std::uint32_t j) const {
    if (bodies[i] == bodies[j] && bodies[i] != nullptr) return false;
    return uniform_bits || ((category[i] & collide[j]) | (category[j] & collide[i])) != 0;
  }
  /// Whether both are spheres whose contact need not be libode's.
  [[nodiscard]] bool are_spheres(IndexPair pair) const {
    return (traits[pair.g1] & traits[pair.g2] & kIsSphere) != 0;
  }
  /// libode's test of two bounds, which calls NaN an overlap.
  [[nodiscard]] bool overlap(std::uint32_t i, std::uint32_t j) const {
    const Real* a = bounds[i].v;
    const Real* b = bounds[j].v;
    return !(a[0] > b[1] || a[1] < b[0] || a[2] > b[3] || a[3] < b[2] || a[4] > b[5] ||
             a[5] < b[4]);
  }

  /// All bounds, for comparing one box with them: packed at the first call after a reading.
  const PackedBounds<Real>& packed();
  /// The same, but null at the first question after a reading.
  const PackedBounds<Real>* packed_if_asked_again();

  /// Asks the memory for what libode's colliders read of a geom.
  void prefetch(std::uint32_t i) const {
    const auto* const geom = reinterpret_cast<const char*>(geoms[i]);
    __builtin_prefetch(geom);
    __builtin_prefetch(geom + kCacheLineBytes);
    __builtin_prefetch(positions_[i]);
    __builtin_prefetch(reinterpret_cast<const char*>(positions_[i]) + kCacheLineBytes);
  }

  // One element per geom.
  std::vector<dxGeom*> geoms;
  std::vector<BoundsBox<Real>> bounds;
  std::vector<SphereOf<Real>> spheres;  ///< zeros where the geom is none
  std::vector<const dxBody*> bodies;
  std::vector<unsigned long> category, collide;
  std::vector<std::uint8_t> traits;

  std::uint8_t all_traits = 0;      ///< or of `traits`
  std::vector<std::uint32_t> near;  ///< scratch memory for those who ask `packed`

  bool uniform_bits = true;   ///< every pair passes the category and collide bits
  bool only_spheres = false;  ///< every geom is one
  /// libode has old bounds of a geom, which become new when anybody asks for them: what it finds
  /// hangs on that, so it is libode's to find.
  bool has_stale = false;

 private:
  void resize(std::size_t count);
  void note_traits(std::uint8_t bits) {
    all_traits |= bits;
    only_spheres = only_spheres && (bits & kIsSphere) != 0;
  }
  /// Where the arrays are, for loops in which they do not grow.
  struct Slots;
  [[nodiscard]] Slots slots();
  /// Returns the geom's traits.
  static std::uint8_t read_geom(const GeomReader<Real>& reader, dxGeom* geom, int number,
                                const Slots& slots, std::size_t slot);
  void find_vacated(std::span<dxGeom* const> moved, SlotChange& change) const;
  [[nodiscard]] bool read_fresh(const GeomReader<Real>& reader, const SlotChange& change);

  std::vector<const Real*>
      positions_;                 ///< where poses are, as far as is known: hints for prefetching
  std::vector<dxGeom*> arrived_;  ///< the geoms of the fresh slots of an update
  std::vector<dxGeom*> left_;     ///< those of the vacated ones
  PackedBounds<Real> packed_;
  bool is_packed_ = false;
  bool was_asked_ = false;  ///< for `packed`, since the reading
};

}  // namespace harpoon::ode
