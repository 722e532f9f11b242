// A block of bodies among those of its own level and against coarser levels.

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
