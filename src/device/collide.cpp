// The single-pair interface: the scalar collider, and the conversion of its result to a record.

#include "base/float_environment.hpp"
#include "collide/scalar.hpp"
#include "harpoon/device.hpp"

namespace harpoon {
namespace {

template <class Real>
ContactOf<Real> collide_pair(const SpherePairOf<Real>& pair) noexcept {
  using Word = typename ContactOf<Real>::FlowWord;
  ContactOf<Real> out;
  const FloatEnvironment environment;
  const SphereOf<Real>& a = pair.s1;
  const SphereOf<Real>& b = pair.s2;
  const auto c = colliders::sphere_sphere<Real>({{a.x, a.y, a.z}, a.r}, {{b.x, b.y, b.z}, b.r});
  if (c.hit) {
    out = ContactOf<Real>{{c.pos.x, c.pos.y, c.pos.z},
                          {c.normal.x, c.normal.y, c.normal.z},
                          c.depth,
                          static_cast<Word>(c.grazing ? Flow::grazing : Flow::real)};
  } else {
    out = ContactOf<Real>{{0, 0, 0}, {0, 0, 0}, 0, static_cast<Word>(Flow::fake)};
  }
  return out;
}

}  // namespace

Contact collide(const SpherePair& pair) noexcept {
  return collide_pair(pair);
}
ContactF64 collide(const SpherePairF64& pair) noexcept {
  return collide_pair(pair);
}

}  // namespace harpoon
