// One source for every instruction set: Highway compiles this file once per target. Bodies lie
// sorted by bucket, so the neighbours of a body are a few contiguous runs; each run is tested a
// vector at a time and the hits are compressed into a list of candidates. Culling may use any
// arithmetic because its radii are inflated; what decides is src/collide/sphere_sphere.inl alone.

#include "scene/kernels.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scene/kernels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "base/instruction_set.hpp"
#include "collide/copy_sphere.inl"
#include "collide/simd.inl"

HWY_BEFORE_NAMESPACE();
namespace harpoon::scene::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
namespace simd = colliders::HWY_NAMESPACE;

template <class T>
using Tag = hn::ScalableTag<T>;
template <class T>
using Vector = hn::Vec<Tag<T>>;
using Index = Tag<std::uint32_t>;
/// Lanes of the vectors that test long runs of neighbours, and short ones: most of those are
/// shorter than eight, wider vectors would carry nothing but work.
template <class T>
constexpr std::size_t kLongRunLanes = HWY_LANES(T);
template <class T>
constexpr std::size_t kShortRunLanes = std::min<std::size_t>(HWY_LANES(T), 8);

constexpr std::size_t kMaxLanes = HWY_MAX_BYTES / sizeof(float);
static_assert(kMaxLanes <= kSlack);
static_assert(std::endian::native == std::endian::little);

/// One vector of bodies, field by field.
template <class T>
struct Bodies {
  Vector<T> x, y, z, r;
};

/// Bodies [i, i + valid) of any source, the last one repeated to fill the vector.
template <class Real>
HWY_INLINE Bodies<Real> load_bodies(const Source<Real>& source, std::size_t i, std::size_t valid) {
  const Tag<Real> d;
  const std::size_t lanes = hn::Lanes(d);
  Bodies<Real> b;
  if (valid >= lanes && source.records()) {
    hn::LoadInterleaved4(d, source.x + 4 * i, b.x, b.y, b.z, b.r);
    return b;
  }
  if (valid >= lanes && source.stride_bytes == sizeof(Real)) {
    return {hn::LoadU(d, source.x + i), hn::LoadU(d, source.y + i), hn::LoadU(d, source.z + i),
            hn::LoadU(d, source.r + i)};
  }
  HWY_ALIGN SphereOf<Real> copy[HWY_MAX_BYTES / sizeof(Real)];
  for (std::size_t l = 0; l < lanes; ++l) copy[l] = source[i + std::min(l, valid - 1)];
  hn::LoadInterleaved4(d, &copy[0].x, b.x, b.y, b.z, b.r);
  return b;
}

// ---- Extremes -------------------------------------------------------------------------------

template <class Real>
Extremes<Real> extremes(const Source<Real>& source, std::size_t begin, std::size_t end) {
  const Tag<Real> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto limit = hn::Set(d, kLimit<Real>);
  const auto high = hn::Set(d, std::numeric_limits<Real>::infinity());
  const auto low = hn::Neg(high);
  Vector<Real> min[4] = {high, high, high, high};
  Vector<Real> max[4] = {low, low, low, low};
  std::size_t invalid = 0;
  for (std::size_t i = begin; i < end; i += lanes) {
    const std::size_t valid_lanes = std::min(lanes, end - i);
    const Bodies<Real> b = load_bodies(source, i, valid_lanes);
    const auto biggest = hn::Max(hn::Max(hn::Abs(b.x), hn::Abs(b.y)), hn::Abs(b.z));
    // Max may hide a NaN, a sum does not.
    const auto sum = hn::Add(hn::Add(b.x, b.y), hn::Add(b.z, b.r));
    const auto valid = hn::And(hn::And(hn::Le(biggest, limit), hn::Eq(sum, sum)),
                               hn::And(hn::Ge(b.r, hn::Zero(d)), hn::Le(b.r, limit)));
    const auto present = hn::FirstN(d, valid_lanes);
    invalid += hn::CountTrue(d, hn::And(hn::Not(valid), present));
    const Vector<Real> fields[4] = {b.x, b.y, b.z, b.r};
    for (int k = 0; k < 4; ++k) {
      min[k] = hn::Min(min[k], hn::IfThenElse(valid, fields[k], high));
      max[k] = hn::Max(max[k], hn::IfThenElse(valid, fields[k], low));
    }
  }
  Extremes<Real> out;
  for (int k = 0; k < 4; ++k) {
    out.min[k] = hn::GetLane(hn::MinOfLanes(d, min[k]));
    out.max[k] = hn::GetLane(hn::MaxOfLanes(d, max[k]));
  }
  out.invalid = invalid;
  return out;
}

template <class Real>
Real largest_move(const SphereOf<Real>* from, const SphereOf<Real>* to, std::size_t count) {
  const Tag<Real> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto source_of = [](const SphereOf<Real>* s, std::size_t n) HWY_ATTR {
    return Source<Real>{&s->x, &s->y, &s->z, &s->r, sizeof *s, n};
  };
  const Source<Real> old_source = source_of(from, count);
  const Source<Real> new_source = source_of(to, count);
  const auto infinite = hn::Set(d, std::numeric_limits<Real>::infinity());
  auto largest = hn::Zero(d);
  for (std::size_t i = 0; i < count; i += lanes) {
    const std::size_t valid = std::min(lanes, count - i);
    const Bodies<Real> a = load_bodies(old_source, i, valid);
    const Bodies<Real> b = load_bodies(new_source, i, valid);
    const auto x = hn::Sub(b.x, a.x);
    const auto y = hn::Sub(b.y, a.y);
    const auto z = hn::Sub(b.z, a.z);
    const auto squared = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
    const auto known = hn::And(hn::Eq(a.r, b.r), hn::Lt(squared, infinite));
    largest = hn::Max(largest, hn::IfThenElse(known, squared, infinite));
  }
  return hn::GetLane(hn::MaxOfLanes(d, largest));
}

// ---- Cells ----------------------------------------------------------------------------------
// The arithmetic that follows is part of the order of results: the same operations on every
// instruction set, no contraction.

/// Cell numbers of one vector of bodies in float, bucket and row parts.
struct CellVectors {
  hn::Vec<Index> bucket, sub_y, sub_z;
};

HWY_INLINE hn::Vec<Index> to_index(const Vector<float>& v) {
  return hn::BitCast(Index(), hn::ConvertTo(Tag<std::int32_t>(), v));
}

HWY_INLINE hn::Vec<Index> shifted(const hn::Vec<Index>& v, std::uint32_t shift) {
  return hn::ShiftRightSame(v, static_cast<int>(shift));
}

template <class Cull>
HWY_INLINE CellVectors cells_of(const Grid<Cull>& grid, const hn::Vec<Index>& ix,
                                const hn::Vec<Index>& sub_y, const hn::Vec<Index>& sub_z) {
  const Index du;
  const auto row_y = hn::Mul(shifted(sub_y, grid.row_shift), hn::Set(du, grid.stride_y));
  const auto row_z = hn::Mul(shifted(sub_z, grid.row_shift), hn::Set(du, grid.stride_z));
  return {hn::And(hn::Add(hn::Add(ix, row_y), row_z), hn::Set(du, grid.mask)), sub_y, sub_z};
}

HWY_INLINE CellVectors cells_of(const Grid<float>& grid, const Vector<float>& x,
                                const Vector<float>& y, const Vector<float>& z) {
  const Tag<float> d;
  const auto per_x = hn::Set(d, grid.cells_per_unit_x);
  const auto per_sub = hn::Set(d, grid.sub_cells_per_unit);
  const auto ix = to_index(hn::Mul(hn::Sub(x, hn::Set(d, grid.origin[0])), per_x));
  const auto sub_y = to_index(hn::Mul(hn::Sub(y, hn::Set(d, grid.origin[1])), per_sub));
  const auto sub_z = to_index(hn::Mul(hn::Sub(z, hn::Set(d, grid.origin[2])), per_sub));
  return cells_of(grid, ix, sub_y, sub_z);
}

/// Cells of sorted bodies from i on.
HWY_INLINE CellVectors cells_at(const CullArrays<float>& bodies, const Grid<float>& grid,
                                std::uint32_t i) {
  const Tag<float> d;
  return cells_of(grid, hn::LoadU(d, bodies.x + i), hn::LoadU(d, bodies.y + i),
                  hn::LoadU(d, bodies.z + i));
}

HWY_INLINE hn::Vec<Index> cell_numbers(const double* at, double origin, double per_unit) {
  const Tag<double> d;
  const hn::Rebind<std::int32_t, Tag<double>> di;
  const hn::RebindToUnsigned<decltype(di)> du;
  HWY_ALIGN std::uint32_t numbers[kMaxLanes];
  for (std::size_t l = 0; l < hn::Lanes(Index()); l += hn::Lanes(d)) {
    const auto offset = hn::Sub(hn::LoadU(d, at + l), hn::Set(d, origin));
    const auto cell = hn::DemoteTo(di, hn::Mul(offset, hn::Set(d, per_unit)));
    hn::StoreU(hn::BitCast(du, cell), du, numbers + l);
  }
  return hn::Load(Index(), numbers);
}

HWY_INLINE CellVectors cells_at(const CullArrays<double>& bodies, const Grid<double>& grid,
                                std::uint32_t i) {
  return cells_of(grid, cell_numbers(bodies.x + i, grid.origin[0], grid.cells_per_unit_x),
                  cell_numbers(bodies.y + i, grid.origin[1], grid.sub_cells_per_unit),
                  cell_numbers(bodies.z + i, grid.origin[2], grid.sub_cells_per_unit));
}

/// The same for one body in double.
struct Cell {
  std::uint32_t bucket, sub_y, sub_z;
};

HWY_INLINE Cell cell_of(const Grid<double>& grid, double x, double y, double z) {
  const auto ix = static_cast<std::uint32_t>((x - grid.origin[0]) * grid.cells_per_unit_x);
  const auto sub_y = static_cast<std::uint32_t>((y - grid.origin[1]) * grid.sub_cells_per_unit);
  const auto sub_z = static_cast<std::uint32_t>((z - grid.origin[2]) * grid.sub_cells_per_unit);
  return {
      (ix + grid.stride_y * (sub_y >> grid.row_shift) + grid.stride_z * (sub_z >> grid.row_shift)) &
          grid.mask,
      sub_y, sub_z};
}

/// Culling coordinates of a float body are its own.
HWY_INLINE Bodies<float> cull_bodies(const Source<float>& source, const CullMap&, std::size_t i,
                                     std::size_t valid) {
  return load_bodies(source, i, valid);
}

/// Those of a double body are taken from the map's origin, where float resolves them.
HWY_INLINE Bodies<float> cull_bodies(const Source<double>& source, const CullMap& map,
                                     std::size_t i, std::size_t valid) {
  const Tag<double> d;
  const hn::Rebind<float, Tag<double>> df;
  const std::size_t step = hn::Lanes(d);
  const std::size_t lanes = hn::Lanes(Tag<float>());
  HWY_ALIGN float fields[4][kMaxLanes];
  for (std::size_t l = 0; l < lanes; l += step) {
    const std::size_t first = std::min(l, valid - 1);
    const Bodies<double> b = load_bodies(source, i + first, valid - first);
    hn::StoreU(hn::DemoteTo(df, hn::Sub(b.x, hn::Set(d, map.origin[0]))), df, fields[0] + l);
    hn::StoreU(hn::DemoteTo(df, hn::Sub(b.y, hn::Set(d, map.origin[1]))), df, fields[1] + l);
    hn::StoreU(hn::DemoteTo(df, hn::Sub(b.z, hn::Set(d, map.origin[2]))), df, fields[2] + l);
    hn::StoreU(hn::DemoteTo(df, b.r), df, fields[3] + l);
  }
  const Tag<float> df_full;
  return {hn::Load(df_full, fields[0]), hn::Load(df_full, fields[1]), hn::Load(df_full, fields[2]),
          hn::Load(df_full, fields[3])};
}

template <class Real>
void buckets_float(const Source<Real>& source, const CullMap& map, const Grid<float>& grid,
                   std::size_t begin, std::size_t end, std::uint32_t* buckets) {
  const Index du;
  const std::size_t lanes = hn::Lanes(du);
  HWY_ALIGN std::uint32_t last[kMaxLanes];
  for (std::size_t i = begin; i < end; i += lanes) {
    const std::size_t valid = std::min(lanes, end - i);
    const Bodies<float> b = cull_bodies(source, map, i, valid);
    const auto bucket = cells_of(grid, b.x, b.y, b.z).bucket;
    if (valid == lanes) {
      hn::StoreU(bucket, du, buckets + i);
    } else {
      hn::Store(bucket, du, last);
      std::memcpy(buckets + i, last, valid * sizeof last[0]);
    }
  }
}

template <class Real>
void buckets_double(const Source<Real>& source, const CullMap&, const Grid<double>& grid,
                    std::size_t begin, std::size_t end, std::uint32_t* buckets) {
  for (std::size_t i = begin; i < end; ++i) {
    const SphereOf<Real> b = source[i];
    buckets[i] =
        cell_of(grid, static_cast<double>(b.x), static_cast<double>(b.y), static_cast<double>(b.z))
            .bucket;
  }
}

template <class Real>
void cull_arrays_float(const SphereOf<Real>* bodies, const CullMap& map, std::size_t begin,
                       std::size_t end, const CullArrays<float>& out) {
  const Tag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  const Source<Real> source{&bodies->x, &bodies->y, &bodies->z, &bodies->r, sizeof bodies[0], end};
  const auto scale = hn::Set(d, static_cast<float>(kRadiusScale));
  const auto pad = hn::Set(d, static_cast<float>(map.radius_pad));
  HWY_ALIGN float last[4][kMaxLanes];
  for (std::size_t i = begin; i < end; i += lanes) {
    const std::size_t valid = std::min(lanes, end - i);
    Bodies<float> b = cull_bodies(source, map, i, valid);
    b.r = hn::Add(hn::Mul(b.r, scale), pad);
    if (valid == lanes) {
      hn::StoreU(b.x, d, out.x + i);
      hn::StoreU(b.y, d, out.y + i);
      hn::StoreU(b.z, d, out.z + i);
      hn::StoreU(b.r, d, out.r + i);
    } else {
      hn::Store(b.x, d, last[0]);
      hn::Store(b.y, d, last[1]);
      hn::Store(b.z, d, last[2]);
      hn::Store(b.r, d, last[3]);
      float* const to[4] = {out.x + i, out.y + i, out.z + i, out.r + i};
      for (int k = 0; k < 4; ++k) std::memcpy(to[k], last[k], valid * sizeof(float));
    }
  }
}

template <class Real>
void cull_arrays_double(const SphereOf<Real>* bodies, const CullMap& map, std::size_t begin,
                        std::size_t end, const CullArrays<double>& out) {
  for (std::size_t i = begin; i < end; ++i) {
    out.x[i] = static_cast<double>(bodies[i].x);
    out.y[i] = static_cast<double>(bodies[i].y);
    out.z[i] = static_cast<double>(bodies[i].z);
    out.r[i] = static_cast<double>(bodies[i].r) * kRadiusScale + map.radius_pad;
  }
}

// ---- Search ---------------------------------------------------------------------------------

/// The end of a list, kept in registers while a block is searched.
struct ListEnd {
  std::uint32_t* i;
  std::uint32_t* j;
  std::size_t count, capacity;
};

HWY_INLINE ListEnd end_of(const Candidates& list) {
  return {list.i, list.j, list.count, list.capacity};
}

HWY_NOINLINE ListEnd make_room(ListEnd end, Candidates& list, RoomMaker& room) {
  list.count = end.count;
  room.make_room(room, list);
  return end_of(list);
}

/// What a search carries from test to test: the end of its list and the doubt about it.
template <class Shape>
struct Cursor : ListEnd {
  [[no_unique_address]] typename Shape::Doubt doubt;

  HWY_INLINE explicit Cursor(const Candidates& list) : ListEnd(end_of(list)) {}
};

/// Exactly as many bytes as the mask has, so that it stays in registers.
template <class D, class M>
HWY_INLINE std::uint32_t mask_bits(D d, const M& mask) {
  std::conditional_t<(hn::MaxLanes(D()) > 8), std::uint16_t, std::uint8_t> bits;
  hn::StoreMaskBits(d, mask, reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}

/// Appends the lanes of `hits`, whose bodies start at sorted position j, as partners of body i;
/// without a branch, because which tests hit is unpredictable.
template <class D, class M>
HWY_INLINE void append(D d, const M& hits, std::uint32_t i, std::uint32_t j, ListEnd& cursor) {
  const hn::Rebind<std::uint32_t, D> du;
  const auto partners = hn::Add(hn::Set(du, j), hn::Iota(du, 0));
  if constexpr (sizeof(hn::TFromD<D>) == sizeof(std::uint32_t)) {
    hn::StoreU(hn::Compress(partners, hn::RebindMask(du, hits)), du, cursor.j + cursor.count);
  } else {
    std::uint8_t bits[sizeof(std::uint64_t)];
    hn::StoreMaskBits(d, hits, bits);
    const auto same = hn::LoadMaskBits(du, bits);
    hn::StoreU(hn::Compress(partners, same), du, cursor.j + cursor.count);
  }
  hn::StoreU(hn::Set(du, i), du, cursor.i + cursor.count);
  cursor.count += hn::CountTrue(d, hits);
}

/// How closely the candidates of some spheres came to being none: the least of reach squared minus
/// distance squared. Culling radii are a little larger than the bodies' own, so only candidates
/// that came close may turn out not to touch.
template <class D>
struct SphereDoubt {
  hn::Vec<D> least;

  HWY_INLINE SphereDoubt() : least(hn::Set(D(), std::numeric_limits<hn::TFromD<D>>::infinity())) {}
  [[nodiscard]] HWY_INLINE bool below(hn::TFromD<D> difference) const {
    return hn::GetLane(hn::MinOfLanes(D(), least)) < difference;
  }
};

/// Boxes that are candidates overlap.
struct NoDoubt {
  template <class Cull>
  [[nodiscard]] HWY_INLINE bool below(Cull) const {
    return false;
  }
};

/// A shape says when two bodies are candidates and what a body covers along an axis. An object of
/// it is the body that a run is tested against, so many lanes at a time.
template <class Cull, std::size_t kLanes>
struct SphereShape {
  using Number = Cull;
  using Lanes = hn::CappedTag<Cull, kLanes>;
  using Doubt = SphereDoubt<Lanes>;
  using Vec = hn::Vec<Lanes>;
  Vec x, y, z, r;

  HWY_INLINE SphereShape(const SearchJob<Cull>& job, std::uint32_t i) {
    const Lanes d;
    x = hn::Set(d, job.bodies.x[i]);
    y = hn::Set(d, job.bodies.y[i]);
    z = hn::Set(d, job.bodies.z[i]);
    r = hn::Set(d, job.bodies.r[i]);
  }

  /// Which of the `present` bodies from sorted position j on are candidates.
  template <class M>
  HWY_INLINE M near(const SearchJob<Cull>& job, std::uint32_t, std::uint32_t j, const M& present,
                    Doubt& doubt) const {
    const Lanes d;
    const CullArrays<Cull>& bodies = job.bodies;
    const auto dx = hn::Sub(hn::LoadU(d, bodies.x + j), x);
    const auto dy = hn::Sub(hn::LoadU(d, bodies.y + j), y);
    const auto dz = hn::Sub(hn::LoadU(d, bodies.z + j), z);
    const auto reach = hn::Add(hn::LoadU(d, bodies.r + j), r);
    // Reach squared minus distance squared.
    const auto inside =
        hn::NegMulAdd(dx, dx, hn::NegMulAdd(dy, dy, hn::NegMulAdd(dz, dz, hn::Mul(reach, reach))));
    const auto within = hn::And(hn::Ge(inside, hn::Zero(d)), present);
    doubt.least = hn::IfThenElse(within, hn::Min(doubt.least, inside), doubt.least);
    return within;
  }

  /// Where the coordinates of partners of a level lie.
  template <class D>
  static HWY_INLINE hn::Vec<D> low(D d, const CullArrays<Cull>& bodies, int axis, std::uint32_t i,
                                   const hn::Vec<D>& largest) {
    return hn::Sub(hn::LoadU(d, at(bodies, axis) + i), reach(d, bodies, i, largest));
  }
  template <class D>
  static HWY_INLINE hn::Vec<D> high(D d, const CullArrays<Cull>& bodies, int axis, std::uint32_t i,
                                    const hn::Vec<D>& largest) {
    return hn::Add(hn::LoadU(d, at(bodies, axis) + i), reach(d, bodies, i, largest));
  }

 private:
  static HWY_INLINE const Cull* at(const CullArrays<Cull>& bodies, int axis) {
    return axis == 0 ? bodies.x : axis == 1 ? bodies.y : bodies.z;
  }
  template <class D>
  static HWY_INLINE hn::Vec<D> reach(D d, const CullArrays<Cull>& bodies, std::uint32_t i,
                                     const hn::Vec<D>& largest) {
    return hn::Add(hn::LoadU(d, bodies.r + i), largest);
  }
};

/// Boxes are sorted by their place. Rounding to culling coordinates is monotone, so closed
/// boxes that overlap still do, and boxes that overlap by more than a touch certainly did.
template <class Cull, std::size_t kLanes>
struct BoxShape {
  using Number = Cull;
  using Lanes = hn::CappedTag<Cull, kLanes>;
  using Doubt = NoDoubt;
  using Vec = hn::Vec<Lanes>;
  Vec x, y, z, high_x, high_y, high_z;

  HWY_INLINE BoxShape(const SearchJob<Cull>& job, std::uint32_t i) {
    const Lanes d;
    x = hn::Set(d, job.bodies.low_x[i]);
    y = hn::Set(d, job.bodies.low_y[i]);
    z = hn::Set(d, job.bodies.low_z[i]);
    high_x = hn::Set(d, job.bodies.high_x[i]);
    high_y = hn::Set(d, job.bodies.high_y[i]);
    high_z = hn::Set(d, job.bodies.high_z[i]);
  }

  template <class M>
  HWY_INLINE M near(const SearchJob<Cull>& job, std::uint32_t i, std::uint32_t j, const M& present,
                    Doubt&) const {
    const Lanes d;
    const CullArrays<Cull>& b = job.bodies;
    // The widest gap along an axis, below 0 where the boxes overlap along all. Differences of
    // finite numbers have the right sign; one operation each is less work than a mask each.
    const auto gap_x =
        hn::Max(hn::Sub(hn::LoadU(d, b.low_x + j), high_x), hn::Sub(x, hn::LoadU(d, b.high_x + j)));
    const auto gap_y =
        hn::Max(hn::Sub(hn::LoadU(d, b.low_y + j), high_y), hn::Sub(y, hn::LoadU(d, b.high_y + j)));
    const auto gap_z =
        hn::Max(hn::Sub(hn::LoadU(d, b.low_z + j), high_z), hn::Sub(z, hn::LoadU(d, b.high_z + j)));
    const auto gap = hn::Max(hn::Max(gap_x, gap_y), gap_z);
    auto hits = hn::And(hn::Le(gap, hn::Zero(d)), present);
    if (job.judge_touching) {
      const auto unsure = hn::And(hits, hn::Eq(gap, hn::Zero(d)));
      if (HWY_UNLIKELY(!hn::AllFalse(d, unsure))) hits = judged(*job.judge, i, j, hits, unsure);
    }
    return hits;
  }

  /// Along an axis that the grid ignores there is one cell, whatever these say.
  template <class D>
  static HWY_INLINE hn::Vec<D> low(D d, const CullArrays<Cull>& b, int axis, std::uint32_t i,
                                   const hn::Vec<D>& largest) {
    const Cull* const at = axis == 0 ? b.x : axis == 1 ? b.y : b.z;
    return hn::Sub(hn::LoadU(d, at + i), hn::Add(largest, largest));
  }
  template <class D>
  static HWY_INLINE hn::Vec<D> high(D d, const CullArrays<Cull>& b, int axis, std::uint32_t i,
                                    const hn::Vec<D>&) {
    const Cull* const at = axis == 0 ? b.high_x : axis == 1 ? b.high_y : b.high_z;
    return hn::LoadU(d, at + i);
  }

 private:
  template <class M>
  static HWY_NOINLINE M judged(const BoxJudge& judge, std::uint32_t i, std::uint32_t j, M hits,
                               M unsure) {
    const Lanes d;
    HWY_ALIGN Cull apart[HWY_MAX_BYTES / sizeof(Cull)] = {};
    for (std::uint32_t bits = mask_bits(d, unsure); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
      apart[lane] = judge.overlap(judge, i, j + lane) ? Cull(0) : Cull(1);
    }
    return hn::And(hits, hn::Eq(hn::Load(d, apart), hn::Zero(d)));
  }
};

/// What the tests of one block share.
template <class Shape>
struct BlockSearch {
  using Cull = typename Shape::Number;
  const SearchJob<Cull> job;
  std::uint32_t begin;  ///< sorted position of the block
  Candidates& list;
  RoomMaker& room;
};

/// Body i against the sorted positions [first, end).
template <class Shape>
HWY_INLINE Cursor<Shape> test_run(const BlockSearch<Shape>& block, std::uint32_t i,
                                  std::uint32_t first, std::uint32_t end, Cursor<Shape> cursor) {
  const typename Shape::Lanes d;
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(d));
  const Shape body(block.job, i);
  std::uint32_t j = first;
  do {
    append(d, body.near(block.job, i, j, hn::FirstN(d, end - j), cursor.doubt), i, j, cursor);
    if (HWY_UNLIKELY(cursor.count + kMaxLanes > cursor.capacity)) {
      static_cast<ListEnd&>(cursor) = make_room(cursor, block.list, block.room);
    }
    j += lanes;
  } while (HWY_UNLIKELY(j < end));
  return cursor;
}

/// The block's k-th body against `length` buckets from `first` on, which may run over the end of a
/// folded table. Adds to `tested`.
template <class Shape, class Cull>
HWY_INLINE Cursor<Shape> test_buckets(const BlockSearch<Shape>& block, const Grid<Cull>& grid,
                                      std::uint32_t k, std::uint32_t first, std::uint32_t length,
                                      Cursor<Shape> cursor, std::uint64_t& tested) {
  const std::uint32_t i = block.begin + k;
  const std::uint32_t last = first + length - 1;
  const std::uint32_t begin = grid.ends[static_cast<std::ptrdiff_t>(first) - 1];
  if (HWY_LIKELY(last < grid.buckets)) {
    const std::uint32_t end = grid.ends[last];
    tested += end - begin;
    return test_run(block, i, begin, end, cursor);
  }
  const std::uint32_t end = grid.ends[last - grid.buckets];
  tested += grid.end - begin + (end - grid.begin);
  cursor = test_run(block, i, begin, grid.end, cursor);
  return test_run(block, i, grid.begin, end, cursor);
}

HWY_INLINE hn::Vec<Index> offsets_from(std::uint32_t k) {
  const Index du;
  return hn::Add(hn::Set(du, k), hn::Iota(du, 0));  // Iota of a variable goes through memory
}

/// Some bodies of a block, as offsets from its first.
struct Selection {
  std::uint32_t count = 0;
  HWY_ALIGN std::uint32_t offset[kBlockBodies + kSlack];

  template <class M>
  HWY_INLINE void add(const hn::Vec<Index>& offsets, const M& mask) {
    const Index du;
    hn::StoreU(hn::Compress(offsets, mask), du, offset + count);
    count += static_cast<std::uint32_t>(hn::CountTrue(du, mask));
  }
  HWY_INLINE void add_if(std::uint32_t value, bool wanted) {
    offset[count] = value;
    count += wanted ? 1 : 0;
  }
};

/// The bodies of a block in their own grid: buckets, and who is at which edge of its row.
struct OwnCells {
  HWY_ALIGN std::uint32_t bucket[kBlockBodies + kSlack];
  Selection last_y, last_z, last_z_last_y, last_z_first_y;
};

template <class Cull>
HWY_INLINE void fill_own_cells(const SearchJob<Cull>& job, const Grid<Cull>& grid,
                               std::uint32_t begin, std::uint32_t count, OwnCells& out) {
  const Index du;
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(du));
  const auto in_row = hn::Set(du, (1U << grid.row_shift) - 1);
  for (std::uint32_t k = 0; k < count; k += lanes) {
    const CellVectors c = cells_at(job.bodies, grid, begin + k);
    hn::StoreU(c.bucket, du, out.bucket + k);
    const auto offsets = offsets_from(k);
    const auto present = hn::FirstN(du, count - k);
    const auto y = hn::And(c.sub_y, in_row);
    const auto last_y = hn::And(present, hn::Eq(y, in_row));
    const auto first_y = hn::And(present, hn::Eq(y, hn::Zero(du)));
    const auto last_z = hn::And(present, hn::Eq(hn::And(c.sub_z, in_row), in_row));
    out.last_y.add(offsets, last_y);
    out.last_z.add(offsets, last_z);
    out.last_z_last_y.add(offsets, hn::And(last_z, last_y));
    out.last_z_first_y.add(offsets, hn::And(last_z, first_y));
  }
}

/// The selected bodies against the neighbouring row `offset` buckets away.
template <class Shape, class Cull>
HWY_INLINE Cursor<Shape> search_row(const BlockSearch<Shape>& block, const Grid<Cull>& grid,
                                    const OwnCells& cells, const Selection& who,
                                    std::uint32_t offset, Cursor<Shape> cursor,
                                    std::uint64_t& tested) {
  const std::uint32_t from = offset - grid.half_window;
  const std::uint32_t length = 2 * grid.half_window + 1;
  for (std::uint32_t n = 0; n < who.count; ++n) {
    const std::uint32_t k = who.offset[n];
    const std::uint32_t first = (cells.bucket[k] + from) & grid.mask;
    cursor = test_buckets(block, grid, k, first, length, cursor, tested);
  }
  return cursor;
}

/// A block among the bodies of its own level: its own rows forward, then the rows after them.
template <class Shape, class Cull>
HWY_NOINLINE SearchResult search_own_level(const SearchJob<Cull>& job, const Grid<Cull>& grid,
                                           std::uint32_t begin, std::uint32_t end, Candidates& list,
                                           RoomMaker& room) {
  OwnCells cells;
  fill_own_cells(job, grid, begin, end - begin, cells);
  const BlockSearch<Shape> block{job, begin, list, room};
  Cursor<Shape> cursor(list);
  std::uint64_t tested = 0;
  for (std::uint32_t i = begin; i < end; ++i) {
    const std::uint32_t k = i - begin;
    const std::uint32_t last = cells.bucket[k] + grid.half_window;
    if (HWY_LIKELY(last < grid.buckets)) {
      tested += grid.ends[last] - i - 1;
      cursor = test_run(block, i, i + 1, grid.ends[last], cursor);
    } else {
      const std::uint32_t wrapped = grid.ends[last - grid.buckets];
      tested += grid.end - i - 1 + (wrapped - grid.begin);
      cursor = test_run(block, i, i + 1, grid.end, cursor);
      cursor = test_run(block, i, grid.begin, wrapped, cursor);
    }
  }
  const std::uint32_t y = grid.stride_y;
  const std::uint32_t z = grid.stride_z;
  cursor = search_row(block, grid, cells, cells.last_y, y, cursor, tested);
  cursor = search_row(block, grid, cells, cells.last_z_first_y, z - y, cursor, tested);
  cursor = search_row(block, grid, cells, cells.last_z, z, cursor, tested);
  cursor = search_row(block, grid, cells, cells.last_z_last_y, z + y, cursor, tested);
  list.count = cursor.count;
  return {tested, cursor.doubt.below(grid.doubtful_below)};
}

/// The bodies of a block in a coarser grid: the first row that each reaches, its cells along x, and
/// who reaches a second row.
struct ForeignCells {
  HWY_ALIGN std::uint32_t first[kBlockBodies + kSlack];
  HWY_ALIGN std::uint32_t length[kBlockBodies + kSlack];
  Selection all, next_y, next_z, next_both;
};

struct Interval {
  hn::Vec<Index> low, high;
};

/// Cells that [low, high] overlaps, of those that hold bodies. Rounding is monotone and coordinates
/// are exact, so no body in it is outside.
HWY_INLINE Interval cells_between(const Vector<float>& low, const Vector<float>& high, float origin,
                                  float per_unit, float last) {
  const Tag<float> d;
  const auto start = hn::Set(d, origin);
  const auto scale = hn::Set(d, per_unit);
  const auto top = hn::Set(d, last);
  const auto from = hn::Mul(hn::Sub(low, start), scale);
  const auto to = hn::Mul(hn::Sub(high, start), scale);
  return {to_index(hn::Min(hn::Max(from, hn::Zero(d)), top)),
          to_index(hn::Min(hn::Max(to, hn::Zero(d)), top))};
}

template <class Shape>
HWY_INLINE void fill_foreign_cells(const SearchJob<float>& job, const Grid<float>& grid,
                                   std::uint32_t begin, std::uint32_t count, ForeignCells& out) {
  const Tag<float> d;
  const Index du;
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(d));
  const auto largest = hn::Set(d, grid.max_radius);
  const std::uint32_t shift = grid.row_shift;
  const auto along = [&](int axis, std::uint32_t i, float per_unit, float last) HWY_ATTR {
    return cells_between(Shape::low(d, job.bodies, axis, i, largest),
                         Shape::high(d, job.bodies, axis, i, largest), grid.origin[axis], per_unit,
                         last);
  };
  for (std::uint32_t k = 0; k < count; k += lanes) {
    const Interval x = along(0, begin + k, grid.cells_per_unit_x, grid.last_cell_x);
    const Interval y = along(1, begin + k, grid.sub_cells_per_unit, grid.last_sub_cell_y);
    const Interval z = along(2, begin + k, grid.sub_cells_per_unit, grid.last_sub_cell_z);
    const auto row_y = shifted(y.low, shift);
    const auto row_z = shifted(z.low, shift);
    const auto first = hn::Add(hn::Add(x.low, hn::Mul(row_y, hn::Set(du, grid.stride_y))),
                               hn::Mul(row_z, hn::Set(du, grid.stride_z)));
    hn::StoreU(first, du, out.first + k);
    hn::StoreU(hn::Add(hn::Sub(x.high, x.low), hn::Set(du, 1)), du, out.length + k);
    const auto offsets = offsets_from(k);
    const auto present = hn::FirstN(du, count - k);
    const auto next_y = hn::And(present, hn::Gt(shifted(y.high, shift), row_y));
    const auto next_z = hn::And(present, hn::Gt(shifted(z.high, shift), row_z));
    out.all.add(offsets, present);
    out.next_y.add(offsets, next_y);
    out.next_z.add(offsets, next_z);
    out.next_both.add(offsets, hn::And(next_y, next_z));
  }
}

struct ScalarInterval {
  std::uint32_t low, high;
};

HWY_INLINE ScalarInterval cells_between(double low, double high, double origin, double per_unit,
                                        double last) {
  const double from = (low - origin) * per_unit;
  const double to = (high - origin) * per_unit;
  return {static_cast<std::uint32_t>(std::min(std::max(from, 0.0), last)),
          static_cast<std::uint32_t>(std::min(std::max(to, 0.0), last))};
}

template <class Shape>
HWY_INLINE void fill_foreign_cells(const SearchJob<double>& job, const Grid<double>& grid,
                                   std::uint32_t begin, std::uint32_t count, ForeignCells& out) {
  const hn::CappedTag<double, 1> one;
  const auto largest = hn::Set(one, grid.max_radius);
  const std::uint32_t shift = grid.row_shift;
  const auto along = [&](int axis, std::uint32_t i, double per_unit, double last) HWY_ATTR {
    return cells_between(hn::GetLane(Shape::low(one, job.bodies, axis, i, largest)),
                         hn::GetLane(Shape::high(one, job.bodies, axis, i, largest)),
                         grid.origin[axis], per_unit, last);
  };
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto x = along(0, begin + k, grid.cells_per_unit_x, grid.last_cell_x);
    const auto y = along(1, begin + k, grid.sub_cells_per_unit, grid.last_sub_cell_y);
    const auto z = along(2, begin + k, grid.sub_cells_per_unit, grid.last_sub_cell_z);
    out.first[k] = x.low + grid.stride_y * (y.low >> shift) + grid.stride_z * (z.low >> shift);
    out.length[k] = x.high - x.low + 1;
    const bool next_y = (y.high >> shift) > (y.low >> shift);
    const bool next_z = (z.high >> shift) > (z.low >> shift);
    out.all.add_if(k, true);
    out.next_y.add_if(k, next_y);
    out.next_z.add_if(k, next_z);
    out.next_both.add_if(k, next_y && next_z);
  }
}

/// The selected bodies against the row `offset` buckets away from the first one of each.
template <class Shape, class Cull>
HWY_INLINE Cursor<Shape> search_row(const BlockSearch<Shape>& block, const Grid<Cull>& grid,
                                    const ForeignCells& cells, const Selection& who,
                                    std::uint32_t offset, Cursor<Shape> cursor,
                                    std::uint64_t& tested) {
  for (std::uint32_t n = 0; n < who.count; ++n) {
    const std::uint32_t k = who.offset[n];
    const std::uint32_t first = (cells.first[k] + offset) & grid.mask;
    cursor = test_buckets(block, grid, k, first, cells.length[k], cursor, tested);
  }
  return cursor;
}

/// A block against the bodies of a coarser level.
template <class Shape, class Cull>
HWY_NOINLINE SearchResult search_coarser_level(const SearchJob<Cull>& job, const Grid<Cull>& grid,
                                               std::uint32_t begin, std::uint32_t end,
                                               Candidates& list, RoomMaker& room) {
  ForeignCells cells;
  fill_foreign_cells<Shape>(job, grid, begin, end - begin, cells);
  const BlockSearch<Shape> block{job, begin, list, room};
  Cursor<Shape> cursor(list);
  std::uint64_t tested = 0;
  const std::uint32_t y = grid.stride_y;
  const std::uint32_t z = grid.stride_z;
  cursor = search_row(block, grid, cells, cells.all, 0, cursor, tested);
  cursor = search_row(block, grid, cells, cells.next_y, y, cursor, tested);
  cursor = search_row(block, grid, cells, cells.next_z, z, cursor, tested);
  cursor = search_row(block, grid, cells, cells.next_both, y + z, cursor, tested);
  list.count = cursor.count;
  return {tested, cursor.doubt.below(grid.doubtful_below)};
}

/// A block against all scanned bodies: each of them in turn against the whole block.
template <class Shape, class Cull>
HWY_NOINLINE SearchResult scan(const SearchJob<Cull>& job, std::uint32_t begin, std::uint32_t end,
                               Candidates& list, RoomMaker& room) {
  const BlockSearch<Shape> block{job, begin, list, room};
  Cursor<Shape> cursor(list);
  for (std::uint32_t i = job.scanned_begin; i < job.scanned_end; ++i) {
    cursor = test_run(block, i, begin, end, cursor);
  }
  list.count = cursor.count;
  return {std::uint64_t{end - begin} * (job.scanned_end - job.scanned_begin), false};
}

/// Scanned bodies [begin, end) among themselves and the later ones. They may lie beyond all culling
/// coordinates, where those are equal.
template <class Shape, class Cull>
HWY_NOINLINE SearchResult scan_scanned(const SearchJob<Cull>& job, std::uint32_t begin,
                                       std::uint32_t end, Candidates& list, RoomMaker& room) {
  SearchJob<Cull> doubtful = job;
  doubtful.judge_touching = true;
  const BlockSearch<Shape> block{doubtful, begin, list, room};
  Cursor<Shape> cursor(list);
  std::uint64_t tested = 0;
  for (std::uint32_t i = begin; i < end; ++i) {
    tested += job.scanned_end - i - 1;
    cursor = test_run(block, i, i + 1, job.scanned_end, cursor);
  }
  list.count = cursor.count;
  return {tested, false};
}

template <template <class, std::size_t> class Shape, class Cull>
SearchResult search(const SearchJob<Cull>& job, std::size_t level, std::uint32_t begin,
                    std::uint32_t end, Candidates& list, RoomMaker& room) {
  using ForLong = Shape<Cull, kLongRunLanes<Cull>>;
  using ForShort = Shape<Cull, kShortRunLanes<Cull>>;
  if (level == job.levels) return scan_scanned<ForLong>(job, begin, end, list, room);
  const Grid<Cull>& own = job.grids[level];
  SearchResult all = own.short_runs ? search_own_level<ForShort>(job, own, begin, end, list, room)
                                    : search_own_level<ForLong>(job, own, begin, end, list, room);
  for (std::size_t coarser = 0; coarser < level; ++coarser) {
    const Grid<Cull>& grid = job.grids[coarser];
    all += grid.short_runs ? search_coarser_level<ForShort>(job, grid, begin, end, list, room)
                           : search_coarser_level<ForLong>(job, grid, begin, end, list, room);
  }
  if (job.scanned_end != job.scanned_begin) all += scan<ForLong>(job, begin, end, list, room);
  return all;
}

// ---- Contacts -------------------------------------------------------------------------------

template <class Real>
using Number = simd::SimdReal<Tag<Real>>;

/// One vector of pairs as records, sphere with the lower id first.
template <class Real>
struct PairBlock {
  HWY_ALIGN SphereOf<Real> s1[HWY_MAX_BYTES / sizeof(Real)];
  HWY_ALIGN SphereOf<Real> s2[HWY_MAX_BYTES / sizeof(Real)];
  HWY_ALIGN std::uint32_t g1[kMaxLanes];
  HWY_ALIGN std::uint32_t g2[kMaxLanes];
};

template <class Real>
HWY_INLINE void load_pair(const SphereOf<Real>* bodies, const std::uint32_t* ids, std::uint32_t i,
                          std::uint32_t j, std::size_t lane, PairBlock<Real>& block) {
  const std::uint32_t a = ids == nullptr ? i : ids[i];
  const std::uint32_t b = ids == nullptr ? j : ids[j];
  // Ids are in no order that a branch predictor could learn.
  const std::uint32_t swap = (i ^ j) & (0U - static_cast<std::uint32_t>(a > b));
  simd::copy_sphere(bodies[i ^ swap], block.s1[lane]);
  simd::copy_sphere(bodies[j ^ swap], block.s2[lane]);
  block.g1[lane] = std::min(a, b);
  block.g2[lane] = std::max(a, b);
}

template <class Real>
HWY_INLINE void load_block(const SphereOf<Real>* bodies, const std::uint32_t* ids,
                           const Candidates& list, std::size_t begin, std::size_t count,
                           PairBlock<Real>& block) {
  const std::size_t lanes = hn::Lanes(Tag<Real>());
  for (std::size_t l = 0; l < count; ++l) {
    load_pair(bodies, ids, list.i[begin + l], list.j[begin + l], l, block);
  }
  for (std::size_t l = count; l < lanes; ++l) {  // pairs that do not touch
    block.s1[l] = {0, 0, 0, 0};
    block.s2[l] = {1, 0, 0, 0};
  }
}

/// Pairs ahead of the one in work whose bodies are fetched.
constexpr std::size_t kFetchAhead = 48;

/// Where positions are ids, bodies lie in no order: their loads are begun long before their use.
template <class Real>
HWY_INLINE void fetch_ahead(const SphereOf<Real>* bodies, const Candidates& list, std::size_t begin,
                            std::size_t end) {
  for (std::size_t p = begin; p < end; ++p) {
    __builtin_prefetch(bodies + list.i[p]);
    __builtin_prefetch(bodies + list.j[p]);
  }
}

template <class Real>
HWY_INLINE simd::SphereArg<Number<Real>> load_spheres(const SphereOf<Real>* spheres) {
  simd::SphereArg<Number<Real>> s;
  hn::LoadInterleaved4(Tag<Real>(), &spheres->x, s.p.x.v, s.p.y.v, s.p.z.v, s.r.v);
  return s;
}

template <class Real>
HWY_FLATTEN void keep_hits(const SphereOf<Real>* bodies, const std::uint32_t* ids,
                           std::size_t begin, Candidates& list) {
  const Tag<Real> d;
  const std::size_t lanes = hn::Lanes(d);
  PairBlock<Real> block;
  std::size_t kept = begin;
  for (std::size_t p = begin; p < list.count; p += lanes) {
    load_block(bodies, ids, list, p, std::min(lanes, list.count - p), block);
    const auto s1 = load_spheres(block.s1);
    const auto s2 = load_spheres(block.s2);
    const auto hit = simd::touches(simd::separation(s1, s2));
    for (std::uint32_t bits = mask_bits(d, hit.m); bits != 0; bits &= bits - 1) {
      const std::size_t from = p + hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
      list.i[kept] = list.i[from];
      list.j[kept] = list.j[from];
      ++kept;
    }
  }
  list.count = kept;
}

/// Contacts of one vector as records, in two halves that interleave four numbers each. The last
/// number of the second half holds ids: in float g1, in double both.
///
///   [ pos.xyz normal.x | normal.yz depth ids ] and in float g2 after them
template <class Real>
struct ContactBlock {
  HWY_ALIGN Real head[4 * (HWY_MAX_BYTES / sizeof(Real))];
  HWY_ALIGN Real tail[4 * (HWY_MAX_BYTES / sizeof(Real))];
};

HWY_INLINE Vector<float> id_numbers(const PairBlock<float>& pairs) {
  return hn::BitCast(Tag<float>(), hn::Load(Tag<std::uint32_t>(), pairs.g1));
}

HWY_INLINE Vector<double> id_numbers(const PairBlock<double>& pairs) {
  const Tag<std::uint64_t> du;
  HWY_ALIGN std::uint64_t both[HWY_MAX_BYTES / sizeof(double)];
  for (std::size_t l = 0; l < hn::Lanes(du); ++l) {
    both[l] = pairs.g1[l] | static_cast<std::uint64_t>(pairs.g2[l]) << 32;
  }
  return hn::BitCast(Tag<double>(), hn::Load(du, both));
}

template <class Real>
HWY_INLINE void store_contact(const PairBlock<Real>& pairs, const ContactBlock<Real>& block,
                              std::size_t lane, BodyContactOf<Real>* out) {
  auto* const to = reinterpret_cast<char*>(out);
  std::memcpy(to, block.head + 4 * lane, 4 * sizeof(Real));
  std::memcpy(to + 4 * sizeof(Real), block.tail + 4 * lane, 4 * sizeof(Real));
  if (sizeof(Real) == sizeof(float)) out->g2 = pairs.g2[lane];
}

template <class Real>
HWY_FLATTEN std::size_t contacts(const SphereOf<Real>* bodies, const std::uint32_t* ids,
                                 const Candidates& list, std::size_t begin, std::size_t end,
                                 BodyContactOf<Real>* out) {
  const Tag<Real> d;
  const std::size_t lanes = hn::Lanes(d);
  const std::uint32_t all = (1U << lanes) - 1;
  PairBlock<Real> pairs;
  ContactBlock<Real> block;
  BodyContactOf<Real>* const first = out;
  if (ids == nullptr) fetch_ahead(bodies, list, begin, std::min(end, begin + kFetchAhead));
  for (std::size_t p = begin; p < end; p += lanes) {
    if (ids == nullptr) {
      fetch_ahead(bodies, list, std::min(end, p + kFetchAhead),
                  std::min(end, p + kFetchAhead + lanes));
    }
    load_block(bodies, ids, list, p, std::min(lanes, end - p), pairs);
    const auto s1 = load_spheres(pairs.s1);
    const auto s2 = load_spheres(pairs.s2);
    const auto c = simd::sphere_sphere<Number<Real>>(s1, s2);
    hn::StoreInterleaved4(c.pos.x.v, c.pos.y.v, c.pos.z.v, c.normal.x.v, d, block.head);
    hn::StoreInterleaved4(c.normal.y.v, c.normal.z.v, c.depth.v, id_numbers(pairs), d, block.tail);
    std::uint32_t bits = mask_bits(d, c.hit.m);
    if (HWY_LIKELY(bits == all)) {
      for (std::size_t l = 0; l < lanes; ++l) store_contact(pairs, block, l, out++);
    } else {
      for (; bits != 0; bits &= bits - 1) {
        store_contact(pairs, block, hwy::Num0BitsBelowLS1Bit_Nonzero32(bits), out++);
      }
    }
  }
  return static_cast<std::size_t>(out - first);
}

template <class Real>
constexpr Kernels<Real> kKernels = {
    extremes<Real>,
    largest_move<Real>,
    keep_hits<Real>,
    contacts<Real>,
    {buckets_float<Real>, cull_arrays_float<Real>, search<SphereShape, float>,
     search<BoxShape, float>},
    {buckets_double<Real>, cull_arrays_double<Real>, search<SphereShape, double>,
     search<BoxShape, double>},
};

const KernelTable* get_kernels() {
  static constexpr KernelTable kTable = {kKernels<float>, kKernels<double>};
  return &kTable;
}

}  // namespace
}  // namespace harpoon::scene::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace harpoon::scene {
namespace {

HWY_EXPORT(get_kernels);

}  // namespace

const KernelTable* find_kernels(std::string_view instruction_set) noexcept {
  const std::int64_t target = find_target(instruction_set);
  return target == 0 ? nullptr : call_for_target(HWY_DISPATCH_TABLE(get_kernels), target);
}

}  // namespace harpoon::scene
#endif
