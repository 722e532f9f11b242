#include "bench/algorithm1.hpp"

#include <cmath>

namespace harpoon::bench {
namespace {

template <class Real>
void subtract_vectors3(Real* res, const Real* a, const Real* b) {
  res[0] = a[0] - b[0];
  res[1] = a[1] - b[1];
  res[2] = a[2] - b[2];
}

template <class Real>
Real vector_length3(const Real* tmp) {
  return std::sqrt(tmp[0] * tmp[0] + tmp[1] * tmp[1] + tmp[2] * tmp[2]);
}

template <class Real>
Real points_distance3(const Real* p1, const Real* p2) {
  Real tmp[3];
  subtract_vectors3(tmp, p1, p2);
  return vector_length3(tmp);
}

template <class Real>
ContactOf<Real> run(const SpherePairOf<Real>& pair) {
  const Real p1[3] = {pair.s1.x, pair.s1.y, pair.s1.z};
  const Real p2[3] = {pair.s2.x, pair.s2.y, pair.s2.z};
  const Real r1 = pair.s1.r;
  const Real r2 = pair.s2.r;
  ContactOf<Real> contact{};

  const Real d = points_distance3(p1, p2);
  if (d > (r1 + r2)) {
    contact.flow_word = static_cast<decltype(contact.flow_word)>(Flow::fake);
    return contact;
  }
  if (d <= 0) {
    contact.pos[0] = p1[0];
    contact.pos[1] = p1[1];
    contact.pos[2] = p1[2];
    contact.normal[0] = 1;
    contact.normal[1] = 0;
    contact.normal[2] = 0;
    contact.depth = r1 + r2;
    contact.flow_word = static_cast<decltype(contact.flow_word)>(Flow::grazing);
  } else {
    const Real d1 = 1 / d;
    contact.normal[0] = (p1[0] - p2[0]) * d1;
    contact.normal[1] = (p1[1] - p2[1]) * d1;
    contact.normal[2] = (p1[2] - p2[2]) * d1;
    const Real k = static_cast<Real>(0.5) * (r2 - r1 - d);
    contact.pos[0] = p1[0] + contact.normal[0] * k;
    contact.pos[1] = p1[1] + contact.normal[1] * k;
    contact.pos[2] = p1[2] + contact.normal[2] * k;
    contact.depth = r1 + r2 - d;
    contact.flow_word = static_cast<decltype(contact.flow_word)>(Flow::real);
  }
  return contact;
}

}  // namespace

Contact algorithm1(const SpherePair& pair) {
  return run(pair);
}
ContactF64 algorithm1(const SpherePairF64& pair) {
  return run(pair);
}

}  // namespace harpoon::bench
