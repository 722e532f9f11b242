// What a shape must say to be searched: when two bodies are candidates, and what a body covers
// along an axis.

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

  /// Which of the boxes of kTreeWidth nodes from `at` on the body may reach into, by bits: the ball
  /// itself decides, not its bounds.
  HWY_INLINE std::uint32_t reaches(const NodeBoxes<Cull>& boxes, std::size_t at) const {
    const Lanes d;
    const auto limit = hn::Mul(hn::Mul(r, r), hn::Set(d, kSphereSlack<Cull>));
    return node_bits(d, [&](std::size_t k) HWY_ATTR {
      const auto dx =
          outside(x, hn::LoadU(d, boxes.low_x + at + k), hn::LoadU(d, boxes.high_x + at + k));
      const auto dy =
          outside(y, hn::LoadU(d, boxes.low_y + at + k), hn::LoadU(d, boxes.high_y + at + k));
      const auto dz =
          outside(z, hn::LoadU(d, boxes.low_z + at + k), hn::LoadU(d, boxes.high_z + at + k));
      return hn::Le(hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz))), limit);
    });
  }

  /// Which of the kTreeWidth bodies from sorted position j on may reach into the box.
  static HWY_INLINE std::uint32_t reaching(const CullArrays<Cull>& bodies, std::uint32_t j,
                                           const NodeBox<Cull>& box) {
    const Lanes d;
    return node_bits(d, [&](std::size_t k) HWY_ATTR {
      const auto away = [&](const Cull* at, int axis) HWY_ATTR {
        return outside(hn::LoadU(d, at + j + k), hn::Set(d, box.low[axis]),
                       hn::Set(d, box.high[axis]));
      };
      const auto dx = away(bodies.x, 0);
      const auto dy = away(bodies.y, 1);
      const auto dz = away(bodies.z, 2);
      const auto radius = hn::LoadU(d, bodies.r + j + k);
      const auto limit = hn::Mul(hn::Mul(radius, radius), hn::Set(d, kSphereSlack<Cull>));
      return hn::Le(hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz))), limit);
    });
  }

  /// Bounds of bodies from sorted position i on, along an axis. They are widened by what rounding
  /// may have taken, because distances to them are compared, not they themselves.
  static HWY_INLINE Vec lowest(const CullArrays<Cull>& bodies, int axis, std::uint32_t i) {
    const Lanes d;
    const auto low = hn::Sub(hn::LoadU(d, at(bodies, axis) + i), hn::LoadU(d, bodies.r + i));
    return hn::Sub(low, hn::Mul(hn::Abs(low), hn::Set(d, kBoundsSlack<Cull>)));
  }
  static HWY_INLINE Vec highest(const CullArrays<Cull>& bodies, int axis, std::uint32_t i) {
    const Lanes d;
    const auto high = hn::Add(hn::LoadU(d, at(bodies, axis) + i), hn::LoadU(d, bodies.r + i));
    return hn::Add(high, hn::Mul(hn::Abs(high), hn::Set(d, kBoundsSlack<Cull>)));
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
    // Bodies of finer levels are no larger; only the pad of one far away may be, and along an axis
    // where it is far its window ends in the last cell all the same.
    return hn::Add(hn::Min(hn::LoadU(d, bodies.r + i), largest), largest);
  }
  /// How far a coordinate is outside of [low, high]; 0 within.
  static HWY_INLINE Vec outside(const Vec& v, const Vec& low, const Vec& high) {
    return hn::Max(hn::Max(hn::Sub(low, v), hn::Sub(v, high)), hn::Zero(Lanes()));
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

  HWY_INLINE std::uint32_t reaches(const NodeBoxes<Cull>& boxes, std::size_t at) const {
    const Lanes d;
    return node_bits(d, [&](std::size_t k) HWY_ATTR {
      const auto along = [&](const Cull* low, const Cull* high, const Vec& from, const Vec& to)
                             HWY_ATTR {
                               return hn::And(hn::Le(hn::LoadU(d, low + at + k), to),
                                              hn::Ge(hn::LoadU(d, high + at + k), from));
                             };
      return hn::And(along(boxes.low_x, boxes.high_x, x, high_x),
                     hn::And(along(boxes.low_y, boxes.high_y, y, high_y),
                             along(boxes.low_z, boxes.high_z, z, high_z)));
    });
  }

  static HWY_INLINE std::uint32_t reaching(const CullArrays<Cull>& b, std::uint32_t j,
                                           const NodeBox<Cull>& box) {
    return meeting(NodeBoxes<Cull>{b.low_x, b.low_y, b.low_z, b.high_x, b.high_y, b.high_z}, j,
                   box);
  }

  static HWY_INLINE Vec lowest(const CullArrays<Cull>& b, int axis, std::uint32_t i) {
    const Cull* const low = axis == 0 ? b.low_x : axis == 1 ? b.low_y : b.low_z;
    return hn::LoadU(Lanes(), low + i);
  }
  static HWY_INLINE Vec highest(const CullArrays<Cull>& b, int axis, std::uint32_t i) {
    const Cull* const high = axis == 0 ? b.high_x : axis == 1 ? b.high_y : b.high_z;
    return hn::LoadU(Lanes(), high + i);
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
