// Bodies to cells and buckets. The arithmetic is part of the order of results: the same operations
// on every instruction set, no contraction.

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
  const auto cell = [&](const Vector<float>& at, int axis, const Vector<float>& per_unit,
                        float last) HWY_ATTR {
    const auto t = hn::Mul(hn::Sub(at, hn::Set(d, grid.origin[axis])), per_unit);
    return to_index(hn::Min(hn::Max(t, hn::Zero(d)), hn::Set(d, last)));
  };
  return cells_of(grid, cell(x, 0, per_x, grid.last_cell_x),
                  cell(y, 1, per_sub, grid.last_sub_cell_y),
                  cell(z, 2, per_sub, grid.last_sub_cell_z));
}

/// Cells of sorted bodies from i on.
HWY_INLINE CellVectors cells_at(const CullArrays<float>& bodies, const Grid<float>& grid,
                                std::uint32_t i) {
  const Tag<float> d;
  return cells_of(grid, hn::LoadU(d, bodies.x + i), hn::LoadU(d, bodies.y + i),
                  hn::LoadU(d, bodies.z + i));
}

HWY_INLINE hn::Vec<Index> cell_numbers(const double* at, double origin, double per_unit,
                                       double last) {
  const Tag<double> d;
  const hn::Rebind<std::int32_t, Tag<double>> di;
  const hn::RebindToUnsigned<decltype(di)> du;
  HWY_ALIGN std::uint32_t numbers[kMaxLanes];
  for (std::size_t l = 0; l < hn::Lanes(Index()); l += hn::Lanes(d)) {
    const auto offset = hn::Sub(hn::LoadU(d, at + l), hn::Set(d, origin));
    const auto t = hn::Mul(offset, hn::Set(d, per_unit));
    const auto cell = hn::DemoteTo(di, hn::Min(hn::Max(t, hn::Zero(d)), hn::Set(d, last)));
    hn::StoreU(hn::BitCast(du, cell), du, numbers + l);
  }
  return hn::Load(Index(), numbers);
}

HWY_INLINE CellVectors cells_at(const CullArrays<double>& bodies, const Grid<double>& grid,
                                std::uint32_t i) {
  return cells_of(
      grid, cell_numbers(bodies.x + i, grid.origin[0], grid.cells_per_unit_x, grid.last_cell_x),
      cell_numbers(bodies.y + i, grid.origin[1], grid.sub_cells_per_unit, grid.last_sub_cell_y),
      cell_numbers(bodies.z + i, grid.origin[2], grid.sub_cells_per_unit, grid.last_sub_cell_z));
}

/// The same for one body in double.
struct Cell {
  std::uint32_t bucket, sub_y, sub_z;
};

HWY_INLINE Cell cell_of(const Grid<double>& grid, double x, double y, double z) {
  const auto cell = [](double at, double origin, double per_unit, double last) {
    return static_cast<std::uint32_t>(std::min(std::max((at - origin) * per_unit, 0.0), last));
  };
  const auto ix = cell(x, grid.origin[0], grid.cells_per_unit_x, grid.last_cell_x);
  const auto sub_y = cell(y, grid.origin[1], grid.sub_cells_per_unit, grid.last_sub_cell_y);
  const auto sub_z = cell(z, grid.origin[2], grid.sub_cells_per_unit, grid.last_sub_cell_z);
  return {
      (ix + grid.stride_y * (sub_y >> grid.row_shift) + grid.stride_z * (sub_z >> grid.row_shift)) &
          grid.mask,
      sub_y, sub_z};
}
