#pragma once

// Brings bodies into the order of the search: level by level, bucket by bucket, by id within a
// bucket. The result depends on the set of bodies only.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/executor.hpp"
#include "harpoon/error.hpp"
#include "scene/buffer.hpp"
#include "scene/kernels.hpp"
#include "scene/plan.hpp"

namespace harpoon::scene {

/// What an ordering needs and leaves behind. Kept between calls for its memory alone.
struct OrderMemory {
  Buffer staged, staged_ids;                  ///< bodies by level
  Buffer parted, parted_ids, parted_buckets;  ///< bodies by part of a level
  Buffer buckets, tables, counts;
  Buffer sorted, ids, cull;
};

/// Bodies in search order: those in grids, then those that are in none and are tested against all.
template <class Real, class Cull>
struct Ordered {
  std::array<Grid<Cull>, kRadiusClasses> grids;  ///< coarsest level first
  std::size_t levels = 0;
  std::size_t bodies = 0;   ///< in grids
  std::size_t scanned = 0;  ///< in none; set before ordering, which makes room for them
  const SphereOf<Real>* spheres = nullptr;
  std::uint32_t* ids = nullptr;
  CullArrays<Cull> cull = {};
};

/// Threads and instruction set of a call.
struct Means {
  Executor* executor;  ///< null: the calling thread
  const KernelTable* kernels;

  [[nodiscard]] unsigned threads() const noexcept {
    return executor == nullptr ? 1 : executor->threads();
  }
  /// Runs `body` for every task; the caller holds a FloatEnvironment.
  template <class Body>
  [[nodiscard]] std::optional<Error> run(std::size_t tasks, const Body& body) const {
    if (executor != nullptr && tasks > 1) {
      return executor->run(tasks, [&body](std::size_t task) { body(task); });
    }
    for (std::size_t task = 0; task < tasks; ++task) body(task);
    return std::nullopt;
  }
  static constexpr std::size_t kMaxPieces = 64;
  /// Pieces of at least `least` elements that [0, count) is cut into.
  [[nodiscard]] std::size_t pieces(std::size_t count, std::size_t least) const noexcept {
    const std::size_t most = threads() == 1 ? 1 : std::min(kMaxPieces, std::size_t{8} * threads());
    return std::clamp<std::size_t>(count / least, 1, most);
  }
  /// Runs body(piece, begin, end) for all of them.
  template <class Body>
  [[nodiscard]] std::optional<Error> run_pieces(std::size_t count, std::size_t least,
                                                const Body& body) const {
    const std::size_t all = pieces(count, least);
    return run(all, [&](std::size_t p) { body(p, count * p / all, count * (p + 1) / all); });
  }
};

/// What one pass over the bodies finds. Invalid ones are appended to `excluded`.
template <class Real>
struct Survey {
  Extremes<Real> extremes;
  Census census;
};

/// Throws std::bad_alloc only (from `excluded`).
template <class Real>
std::optional<Error> survey(const Means& means, const Source<Real>& source, double margin,
                            std::vector<std::uint32_t>& excluded, Survey<Real>& out);

/// Orders the valid bodies. Places of scanned bodies are left for the caller to fill.
template <class Real, class Cull>
std::optional<Error> order(const Means& means, const Source<Real>& source,
                           const Survey<Real>& survey, const Plan& plan, OrderMemory& memory,
                           Ordered<Real, Cull>& out);

}  // namespace harpoon::scene
