// Bodies of any source, a vector at a time.

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
