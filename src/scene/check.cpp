#include "scene/check.hpp"

#include <fmt/format.h>

namespace harpoon::scene {
namespace {

template <class Element>
bool fits(std::span<const Element> filter, std::size_t bodies) noexcept {
  return filter.empty() || filter.size() == bodies;
}

}  // namespace

template <class Real>
std::optional<Error> check(const BodiesOf<Real>& bodies) {
  if (bodies.count > kMaxBodies) {
    return Error{Errc::batch_too_large,
                 fmt::format("{} bodies, the limit is {}", bodies.count, kMaxBodies)};
  }
  if (bodies.count != 0 &&
      (bodies.x == nullptr || bodies.y == nullptr || bodies.z == nullptr || bodies.r == nullptr)) {
    return Error{Errc::invalid_argument, "an array of the bodies is null"};
  }
  if (bodies.stride_bytes % alignof(Real) != 0) {
    return Error{Errc::invalid_argument, fmt::format("a stride of {} bytes is not a multiple of {}",
                                                     bodies.stride_bytes, alignof(Real))};
  }
  const Filters& f = bodies.filters;
  if (!fits(f.category, bodies.count) || !fits(f.collide, bodies.count) ||
      !fits(f.owner, bodies.count) || !fits(f.rest, bodies.count) ||
      f.category.size() != f.collide.size()) {
    return Error{Errc::invalid_argument,
                 fmt::format("a filter has another length than the {} bodies", bodies.count)};
  }
  return std::nullopt;
}

template std::optional<Error> check(const BodiesOf<float>&);
template std::optional<Error> check(const BodiesOf<double>&);

}  // namespace harpoon::scene
