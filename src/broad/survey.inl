// What one pass over all bodies finds: extremes, and how far they have moved.

template <class Real>
Extremes<Real> extremes(const Source<Real>& source, const Limits<Real>& limits, std::size_t begin,
                        std::size_t end) {
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
    // A NaN is within nothing.
    const auto within = [&](const Vector<Real>& v, int axis) HWY_ATTR {
      return hn::And(hn::Ge(v, hn::Set(d, limits.low[axis])),
                     hn::Le(v, hn::Set(d, limits.high[axis])));
    };
    const auto valid =
        hn::And(hn::And(within(b.x, 0), within(b.y, 1)),
                hn::And(within(b.z, 2), hn::And(hn::Ge(b.r, hn::Zero(d)), hn::Le(b.r, limit))));
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
