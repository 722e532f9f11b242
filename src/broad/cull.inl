// Bodies to culling coordinates, and those to buckets.

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
    const auto most = hn::Set(d, kFarCoordinate);
    const auto near = [&](const Vector<double>& at, int axis) HWY_ATTR {
      const auto offset = hn::Sub(at, hn::Set(d, map.origin[axis]));
      return hn::DemoteTo(df, hn::Min(hn::Max(offset, hn::Neg(most)), most));
    };
    hn::StoreU(near(b.x, 0), df, fields[0] + l);
    hn::StoreU(near(b.y, 1), df, fields[1] + l);
    hn::StoreU(near(b.z, 2), df, fields[2] + l);
    hn::StoreU(hn::DemoteTo(df, hn::Min(b.r, hn::Set(d, kFarRadius))), df, fields[3] + l);
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
    auto body_pad = pad;
    if constexpr (sizeof(Real) > sizeof(float)) {
      const auto farthest = hn::Max(hn::Max(hn::Abs(b.x), hn::Abs(b.y)), hn::Abs(b.z));
      body_pad = hn::Max(pad, hn::Mul(farthest, hn::Set(d, static_cast<float>(kFarPad))));
    }
    b.r = hn::Add(hn::Mul(b.r, scale), body_pad);
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
