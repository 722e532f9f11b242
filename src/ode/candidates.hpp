#pragma once

// Finds the pairs of a mirror whose bounds overlap and that pass libode's filters: a set, without
// order or orientation. The order rules start from it.

#include <span>
#include <vector>

#include "harpoon/scene.hpp"
#include "ode/mirror.hpp"

namespace harpoon::ode {

template <class Real>
class CandidateFinder {
 public:
  /// Errors: as `Workspace::make`.
  static Result<CandidateFinder> make() noexcept;

  /// All pairs (i < j) of `mirror` whose closed `bounds`, one box per geom, overlap, and that
  /// `mirror.counts`. Boxes with NaN or inverted take part by libode's own comparison; those marked
  /// in `skip` (empty, or one byte per geom) do not take part. Valid until the next call.
  /// Errors: out_of_memory, batch_too_large, executor_failed.
  Result<std::span<const IndexPair>> find(const Mirror<Real>& mirror,
                                          std::span<const BoundsBox<Real>> bounds,
                                          std::span<const std::uint8_t> skip = {});

 private:
  explicit CandidateFinder(Workspace workspace) : workspace_(std::move(workspace)) {}
  [[nodiscard]] std::optional<Error> find_regular(std::span<const BoundsBox<Real>> bounds,
                                                  const Filters& filters);
  [[nodiscard]] Filters coarse_filters(const Mirror<Real>& mirror,
                                       std::span<const std::uint8_t> skip);
  void keep_counting(const Mirror<Real>& mirror, std::span<const std::uint8_t> skip);
  void add_odd(const Mirror<Real>& mirror, std::span<const std::uint8_t> skip);

  Workspace workspace_;
  std::vector<IndexPair> pairs_;
  PackedBounds<Real> packed_;
  std::vector<std::uint32_t> near_;
  std::vector<std::uint32_t> category_, collide_;
};

}  // namespace harpoon::ode
