// Candidates to hits and contacts: the exact collider on gathered pairs.

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
