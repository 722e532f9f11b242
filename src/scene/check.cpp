#include "scene/check.hpp"

#include <fmt/format.h>

namespace harpoon::scene {
namespace {

template <class Element>
bool fits(std::span<const Element> filter, std::size_t bodies) noexcept {
  return filter.empty() || filter.size() == bodies;
}

/// What views of all shapes have in common.
std::optional<Error> check_view(std::size_t count, bool null_array, std::size_t stride_bytes,
                                std::size_t alignment, const Filters& f) {
  if (count > kMaxBodies) {
    return Error{Errc::batch_too_large,
                 fmt::format("{} bodies, the limit is {}", count, kMaxBodies)};
  }
  if (count != 0 && null_array) {
    return Error{Errc::invalid_argument, "an array of the bodies is null"};
  }
  if (stride_bytes % alignment != 0) {
    return Error{Errc::invalid_argument, fmt::format("a stride of {} bytes is not a multiple of {}",
                                                     stride_bytes, alignment)};
  }
  if (!fits(f.category, count) || !fits(f.collide, count) || !fits(f.owner, count) ||
      !fits(f.rest, count) || f.category.size() != f.collide.size()) {
    return Error{Errc::invalid_argument,
                 fmt::format("a filter has another length than the {} bodies", count)};
  }
  return std::nullopt;
}

}  // namespace

template <class Real>
std::optional<Error> check(const BodiesOf<Real>& b) {
  const bool null_array = b.x == nullptr || b.y == nullptr || b.z == nullptr || b.r == nullptr;
  return check_view(b.count, null_array, b.stride_bytes, alignof(Real), b.filters);
}

template <class Real>
std::optional<Error> check(const BoundsOf<Real>& b) {
  return check_view(b.count, b.first == nullptr, b.stride_bytes, alignof(Real), b.filters);
}

template std::optional<Error> check(const BodiesOf<float>&);
template std::optional<Error> check(const BodiesOf<double>&);
template std::optional<Error> check(const BoundsOf<float>&);
template std::optional<Error> check(const BoundsOf<double>&);

}  // namespace harpoon::scene
