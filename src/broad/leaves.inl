// Leaves: the bodies of a block by kTreeWidth, with a box around each. What is large, or few, is
// tested against the boxes first: that is all it costs where it only passes by.

/// Boxes of the leaves of [begin, end) to `out` from `at` on; returns their number.
template <class Shape, class Cull>
HWY_INLINE std::uint32_t fill_leaves(const CullArrays<Cull>& bodies, std::uint32_t begin,
                                     std::uint32_t end, const NodeBoxes<Cull>& out,
                                     std::size_t at) {
  const typename Shape::Lanes d;
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(d));
  const auto most = hn::Set(d, std::numeric_limits<Cull>::infinity());
  Cull* const to_low[3] = {out.low_x, out.low_y, out.low_z};
  Cull* const to_high[3] = {out.high_x, out.high_y, out.high_z};
  std::uint32_t leaf = 0;
  for (std::uint32_t first = begin; first < end; first += kTreeWidth, ++leaf) {
    const std::uint32_t last = std::min(end, first + kTreeWidth);
    for (int axis = 0; axis < 3; ++axis) {
      auto low = most;
      auto high = hn::Neg(most);
      for (std::uint32_t j = first; j < last; j += lanes) {
        const auto present = hn::FirstN(d, last - j);
        low = hn::Min(low, hn::IfThenElse(present, Shape::lowest(bodies, axis, j), most));
        high =
            hn::Max(high, hn::IfThenElse(present, Shape::highest(bodies, axis, j), hn::Neg(most)));
      }
      to_low[axis][at + leaf] = hn::GetLane(hn::MinOfLanes(d, low));
      to_high[axis][at + leaf] = hn::GetLane(hn::MaxOfLanes(d, high));
    }
  }
  return leaf;
}

/// Makes nodes [from, to) boxes that meet nothing.
template <class Cull>
void clear_boxes(const NodeBoxes<Cull>& boxes, std::size_t from, std::size_t to) {
  constexpr Cull kInfinity = std::numeric_limits<Cull>::infinity();
  for (Cull* low : {boxes.low_x, boxes.low_y, boxes.low_z}) {
    std::fill(low + from, low + to, kInfinity);
  }
  for (Cull* high : {boxes.high_x, boxes.high_y, boxes.high_z}) {
    std::fill(high + from, high + to, -kInfinity);
  }
}

/// The box around nodes [from, to).
template <class Cull>
NodeBox<Cull> around(const NodeBoxes<Cull>& boxes, std::size_t from, std::size_t to) {
  return {{*std::min_element(boxes.low_x + from, boxes.low_x + to),
           *std::min_element(boxes.low_y + from, boxes.low_y + to),
           *std::min_element(boxes.low_z + from, boxes.low_z + to)},
          {*std::max_element(boxes.high_x + from, boxes.high_x + to),
           *std::max_element(boxes.high_y + from, boxes.high_y + to),
           *std::max_element(boxes.high_z + from, boxes.high_z + to)}};
}

/// A block of bodies as other bodies meet it.
template <class Cull>
struct BlockLeaves {
  NodeBoxes<Cull> boxes;
  std::size_t at;  ///< first node
  std::uint32_t begin, end;
  NodeBox<Cull> box;
  Cull max_radius;  ///< of spheres
};

/// Bodies [first, last), at most kTreeWidth, in turn against a block. Adds to `found`, whose tests
/// are those of scanned bodies.
template <class Shape, class Cull>
HWY_INLINE Cursor<Shape> test_against(const BlockSearch<Shape>& block,
                                      const BlockLeaves<Cull>& leaves, std::uint32_t first,
                                      std::uint32_t last, Cursor<Shape> cursor,
                                      SearchResult& found) {
  const std::uint32_t present = (std::uint32_t{2} << (last - first - 1)) - 1;
  each_bit(Shape::reaching(block.job.bodies, first, leaves.box) & present,
           [&](std::uint32_t k) HWY_ATTR {
             const std::uint32_t i = first + k;
             const Shape body(block.job, i);
             cursor.doubt = {};
             each_bit(body.reaches(leaves.boxes, leaves.at), [&](std::uint32_t leaf) HWY_ATTR {
               const std::uint32_t from = leaves.begin + leaf * kTreeWidth;
               const std::uint32_t to = std::min(leaves.end, from + kTreeWidth);
               found.scan_tests += to - from;
               cursor = test_run(block, i, from, to, cursor);
             });
             const Cull radius = std::max(leaves.max_radius, block.job.bodies.r[i]);
             found.doubtful |= cursor.doubt.below(doubtful_below(radius, block.job.radius_pad));
           });
  return cursor;
}
