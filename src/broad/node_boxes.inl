// Boxes of kTreeWidth nodes tested at a time. A test gives bits, node by node.

/// Room for the rounding of bounds of spheres and of distances to them (docs/scene.md).
template <class Cull>
constexpr Cull kBoundsSlack = 4 * std::numeric_limits<Cull>::epsilon();
template <class Cull>
constexpr Cull kSphereSlack = 1 + Cull(0x1p-16);

/// One box, in culling coordinates.
template <class Cull>
struct NodeBox {
  Cull low[3], high[3];
};

/// The bits of test(k) for the lanes of nodes k on.
template <class D, class Test>
HWY_INLINE std::uint32_t node_bits(D d, const Test& test) {
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) bits |= mask_bits(d, test(k)) << k;
  return bits;
}

/// Which of the kTreeWidth boxes from `at` on meet the box.
template <class Cull>
HWY_INLINE std::uint32_t meeting(const NodeBoxes<Cull>& boxes, std::size_t at,
                                 const NodeBox<Cull>& box) {
  const hn::CappedTag<Cull, kTreeWidth> d;
  return node_bits(d, [&](std::size_t k) HWY_ATTR {
    const auto along = [&](const Cull* low, const Cull* high, int axis) HWY_ATTR {
      return hn::And(hn::Le(hn::LoadU(d, low + at + k), hn::Set(d, box.high[axis])),
                     hn::Ge(hn::LoadU(d, high + at + k), hn::Set(d, box.low[axis])));
    };
    return hn::And(
        along(boxes.low_x, boxes.high_x, 0),
        hn::And(along(boxes.low_y, boxes.high_y, 1), along(boxes.low_z, boxes.high_z, 2)));
  });
}

template <class Cull>
HWY_INLINE NodeBox<Cull> box_at(const NodeBoxes<Cull>& boxes, std::size_t at) {
  return {{boxes.low_x[at], boxes.low_y[at], boxes.low_z[at]},
          {boxes.high_x[at], boxes.high_y[at], boxes.high_z[at]}};
}

/// Calls visit(k) for the bits that are set, the lowest first.
template <class Visit>
HWY_INLINE void each_bit(std::uint32_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) {
    visit(static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits)));
  }
}
