// Records to vectors and back, for one instruction set: a vector of N pairs is 8 N numbers of
// memory, to be turned into eight vectors of one field each.
//
// The work is shuffles, and those bind the kernels, so the wide layouts do part of it with loads: a
// load that starts half a record early or late puts a sphere into the other half of its vector, and
// a blend (cheap) joins two such loads. What is left is one 4x4 transpose inside each 128-bit block
// (f32) or each pair of blocks (f64). Which pair lands in which lane is `pair_of_lane`.

#if defined(HARPOON_CPU_RECORDS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HARPOON_CPU_RECORDS_INL
#undef HARPOON_CPU_RECORDS_INL
#else
#define HARPOON_CPU_RECORDS_INL
#endif

#include "collide/simd.inl"
#include "harpoon/records.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace harpoon::cpu::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace simd = colliders::HWY_NAMESPACE;

template <class Real>
using Tag = hn::ScalableTag<Real>;
template <class Real>
using Vector = hn::Vec<Tag<Real>>;
template <class Real>
using Args = simd::SphereArg<simd::SimdReal<Tag<Real>>>;

/// Four fields of N records. Named members, not an array: compilers keep them in registers.
template <class V>
struct Quad {
  V a, b, c, d;
};

/// Eight fields of N records: of a pair p1.xyz r1 | p2.xyz r2, of a contact pos.xyz normal.x |
/// normal.yz depth flow.
template <class Real>
struct Fields {
  Quad<Vector<Real>> first, second;
};

enum class Layout {
  blocks_f32,   ///< four numbers to a 128-bit block: any f32 vector of known width
  blocks_f64,   ///< four numbers to two blocks: f64 vectors of 256 or 512 bits
  interleaved,  ///< whatever Highway offers: everything else
};

template <class Real>
constexpr Layout kLayout =
#if HWY_TARGET == HWY_SCALAR || HWY_HAVE_SCALABLE
    Layout::interleaved;
#else
    sizeof(Real) == 4                ? Layout::blocks_f32
    : hn::MaxLanes(Tag<Real>()) >= 4 ? Layout::blocks_f64
                                     : Layout::interleaved;
#endif

/// The pair (0 to N - 1, in memory order) that lane `lane` of every field belongs to.
template <class Real>
HWY_INLINE std::size_t pair_of_lane(std::size_t lane) {
  const std::size_t lanes = hn::Lanes(Tag<Real>());
  if constexpr (kLayout<Real> == Layout::blocks_f32) {
    if (lanes == 4) return lane;
    const std::size_t block = lane / 4;
    return lane % 4 * (lanes / 8) + block / 2 + block % 2 * (lanes / 2);
  } else if constexpr (kLayout<Real> == Layout::blocks_f64) {
    return lane;
  } else {
    return lanes == 1 ? 0 : lane / 2 + lane % 2 * (lanes / 2);
  }
}

#if HWY_TARGET == HWY_SCALAR

template <class V>
HWY_INLINE void exchange_odd_even(V&, V&) {}

#else

/// Exchanges the odd lanes of `a` with the even lanes of `b`, neighbour by neighbour. It is its own
/// inverse.
template <class V>
HWY_INLINE void exchange_odd_even(V& a, V& b) {
  const V even = hn::OddEven(hn::DupEven(b), a);
  b = hn::OddEven(b, hn::DupOdd(a));
  a = even;
}

#endif

#if HWY_TARGET != HWY_SCALAR && !HWY_HAVE_SCALABLE

/// Transposes the 4x4 numbers of every 128-bit block. It is its own inverse.
HWY_INLINE void transpose_blocks(Quad<Vector<float>>& q) {
  const Tag<float> d;
  const hn::Repartition<double, Tag<float>> dd;
  const auto t0 = hn::BitCast(dd, hn::InterleaveLower(d, q.a, q.b));
  const auto t1 = hn::BitCast(dd, hn::InterleaveUpper(d, q.a, q.b));
  const auto t2 = hn::BitCast(dd, hn::InterleaveLower(d, q.c, q.d));
  const auto t3 = hn::BitCast(dd, hn::InterleaveUpper(d, q.c, q.d));
  q.a = hn::BitCast(d, hn::InterleaveLower(dd, t0, t2));
  q.b = hn::BitCast(d, hn::InterleaveUpper(dd, t0, t2));
  q.c = hn::BitCast(d, hn::InterleaveLower(dd, t1, t3));
  q.d = hn::BitCast(d, hn::InterleaveUpper(dd, t1, t3));
}

/// Exchanges the odd blocks of `a` with the even blocks of `b`. It is its own inverse.
template <class V>
HWY_INLINE void exchange_odd_even_blocks(V& a, V& b) {
  const V even = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(b), a);
  b = hn::OddEvenBlocks(b, hn::SwapAdjacentBlocks(a));
  a = even;
}

/// Transposes the 4x4 numbers of every two 128-bit blocks. It is its own inverse.
HWY_INLINE void transpose_block_pairs(Quad<Vector<double>>& q) {
  const Tag<double> d;
  auto t0 = hn::InterleaveLower(d, q.a, q.b);
  auto t1 = hn::InterleaveUpper(d, q.a, q.b);
  auto t2 = hn::InterleaveLower(d, q.c, q.d);
  auto t3 = hn::InterleaveUpper(d, q.c, q.d);
  exchange_odd_even_blocks(t0, t2);
  exchange_odd_even_blocks(t1, t3);
  q = {t0, t1, t2, t3};
}

/// Row `row` (0 to 3) of the records: the first and the second half of some of them, one block or
/// one pair of blocks each.
template <std::size_t row>
HWY_INLINE void load_row(const float* from, Vector<float>& first, Vector<float>& second) {
  const Tag<float> d;
  constexpr std::size_t kLanes = hn::MaxLanes(d);
  if constexpr (kLanes == 4) {
    first = hn::LoadU(d, from + 8 * row);
    second = hn::LoadU(d, from + 8 * row + 4);
  } else {
    const float* low = from + row * kLanes;
    const float* high = low + 4 * kLanes;
    first = hn::OddEvenBlocks(hn::LoadU(d, high - 4), hn::LoadU(d, low));
    second = hn::OddEvenBlocks(hn::LoadU(d, high), hn::LoadU(d, low + 4));
  }
}

template <std::size_t row>
HWY_INLINE void load_row(const double* from, Vector<double>& first, Vector<double>& second) {
  const Tag<double> d;
  const double* low = from + 8 * row;
  if constexpr (hn::MaxLanes(d) == 4) {
    first = hn::LoadU(d, low);
    second = hn::LoadU(d, low + 4);
  } else {
    first = hn::ConcatUpperLower(d, hn::LoadU(d, low + 28), hn::LoadU(d, low));
    second = hn::ConcatUpperLower(d, hn::LoadU(d, low + 32), hn::LoadU(d, low + 4));
  }
}

template <std::size_t row>
HWY_INLINE void store_row(Vector<float> first, Vector<float> second, float* to) {
  const Tag<float> d;
  constexpr std::size_t kLanes = hn::MaxLanes(d);
  if constexpr (kLanes == 4) {
    hn::StoreU(first, d, to + 8 * row);
    hn::StoreU(second, d, to + 8 * row + 4);
  } else {
    exchange_odd_even_blocks(first, second);
    hn::StoreU(first, d, to + row * kLanes);
    hn::StoreU(second, d, to + row * kLanes + 4 * kLanes);
  }
}

template <std::size_t row>
HWY_INLINE void store_row(Vector<double> first, Vector<double> second, double* to) {
  const Tag<double> d;
  double* low = to + 8 * row;
  if constexpr (hn::MaxLanes(d) == 4) {
    hn::StoreU(first, d, low);
    hn::StoreU(second, d, low + 4);
  } else {
    hn::StoreU(hn::ConcatLowerLower(d, second, first), d, low);
    hn::StoreU(hn::ConcatUpperUpper(d, second, first), d, low + 32);
  }
}

HWY_INLINE void transpose(Quad<Vector<float>>& q) {
  transpose_blocks(q);
}
HWY_INLINE void transpose(Quad<Vector<double>>& q) {
  transpose_block_pairs(q);
}

template <class Real>
HWY_INLINE void load_blocks(const Real* from, Fields<Real>& f) {
  load_row<0>(from, f.first.a, f.second.a);
  load_row<1>(from, f.first.b, f.second.b);
  load_row<2>(from, f.first.c, f.second.c);
  load_row<3>(from, f.first.d, f.second.d);
  transpose(f.first);
  transpose(f.second);
}

template <class Real>
HWY_INLINE void store_blocks(Fields<Real> f, Real* to) {
  transpose(f.first);
  transpose(f.second);
  store_row<0>(f.first.a, f.second.a, to);
  store_row<1>(f.first.b, f.second.b, to);
  store_row<2>(f.first.c, f.second.c, to);
  store_row<3>(f.first.d, f.second.d, to);
}

#endif

template <class Real>
HWY_INLINE void exchange_quads(Fields<Real>& f) {
  exchange_odd_even(f.first.a, f.second.a);
  exchange_odd_even(f.first.b, f.second.b);
  exchange_odd_even(f.first.c, f.second.c);
  exchange_odd_even(f.first.d, f.second.d);
}

/// Reads N records.
template <class Real>
HWY_INLINE Fields<Real> load_fields(const Real* from) {
  Fields<Real> f;
  if constexpr (kLayout<Real> == Layout::interleaved) {
    const Tag<Real> d;
    hn::LoadInterleaved4(d, from, f.first.a, f.first.b, f.first.c, f.first.d);
    hn::LoadInterleaved4(d, from + 4 * hn::Lanes(d), f.second.a, f.second.b, f.second.c,
                         f.second.d);
    exchange_quads(f);
  } else {
    load_blocks(from, f);
  }
  return f;
}

/// Writes N records.
template <class Real>
HWY_INLINE void store_fields(Fields<Real> f, Real* to) {
  if constexpr (kLayout<Real> == Layout::interleaved) {
    const Tag<Real> d;
    exchange_quads(f);
    hn::StoreInterleaved4(f.first.a, f.first.b, f.first.c, f.first.d, d, to);
    hn::StoreInterleaved4(f.second.a, f.second.b, f.second.c, f.second.d, d, to + 4 * hn::Lanes(d));
  } else {
    store_blocks(f, to);
  }
}

/// Reads N pairs.
template <class Real>
HWY_INLINE void load_pairs(const SpherePairOf<Real>* pairs, Args<Real>& s1, Args<Real>& s2) {
  const Fields<Real> f = load_fields(&pairs->s1.x);
  s1 = {{f.first.a, f.first.b, f.first.c}, f.first.d};
  s2 = {{f.second.a, f.second.b, f.second.c}, f.second.d};
}

}  // namespace harpoon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
