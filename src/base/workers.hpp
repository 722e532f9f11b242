#pragma once

// The threads of a call, and how work is cut among them.

#include <algorithm>
#include <cstddef>
#include <optional>

#include "base/executor.hpp"
#include "harpoon/error.hpp"

namespace harpoon {

struct Workers {
  Executor* executor;  ///< null: the calling thread

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

}  // namespace harpoon
