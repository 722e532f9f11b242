#pragma once

// One of libode's traversals as a sequence of pairs that its user takes one by one. It runs on a
// stack of its own and stands still inside its callback between two pairs, so that it sees whatever
// is changed meanwhile, as it would if the program had called it. The program's callbacks do not
// run here: they stay on the program's stack.

#include <ucontext.h>

#include <cstddef>
#include <exception>
#include <optional>
#include <utility>

#include "ode/types.hpp"

namespace harpoon::ode {

/// A call of libode's that walks over pairs: dSpaceCollide of `o1`, or dSpaceCollide2 of both.
template <class Real>
struct Traversal {
  const LibodeOf<Real>* ode;
  dxGeom* o1;
  dxGeom* o2 = nullptr;  ///< null: dSpaceCollide

  void operator()(void* data, NearCallback* callback) const {
    if (o2 == nullptr) {
      ode->space_collide(as_space(o1), data, callback);
    } else {
      ode->space_collide2(o1, o2, data, callback);
    }
  }
};

/// Memory for a walk, with a page behind it that ends the process when it is touched. The calling
/// thread keeps a few for its next calls.
class WalkStack {
 public:
  /// Nothing when there is no memory.
  static std::optional<WalkStack> take() noexcept;
  WalkStack(WalkStack&& other) noexcept : memory_(std::exchange(other.memory_, nullptr)) {}
  WalkStack& operator=(WalkStack&& other) noexcept {
    std::swap(memory_, other.memory_);
    return *this;
  }
  WalkStack(const WalkStack&) = delete;
  WalkStack& operator=(const WalkStack&) = delete;
  ~WalkStack();

  [[nodiscard]] void* begin() const;
  [[nodiscard]] static std::size_t size();

 private:
  explicit WalkStack(void* memory) : memory_(memory) {}
  void* memory_;
};

/// The walk, whatever the precision. Everything happens on the thread that calls.
class Walk {
 public:
  using Run = void(const void* traversal, void* data, NearCallback* callback);

  /// Nothing runs until the first `next`. `traversal` outlives the walk.
  Walk(Run* run, const void* traversal, WalkStack stack);
  /// A walk that is not at its end goes there first: libode unlocks the space and frees its memory.
  ~Walk();
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;

  /// The next pair; false at the end. Throws what libode throws, which is the end too.
  [[nodiscard]] bool next(GeomPair& pair);
  /// Goes on to a pair, which is then the last that `next` has given; false when it does not come.
  /// The same.
  [[nodiscard]] bool skip_to(GeomPair pair);
  /// The space is gone: what libode was doing with it stays undone.
  void abandon() { ended_ = true; }

 private:
  static void near(void* walk, dxGeom* o1, dxGeom* o2);
  static void begin();
  void resume();

  Run* const run_;
  const void* const traversal_;
  const WalkStack stack_;
  GeomPair pair_{};
  std::optional<GeomPair> sought_;
  std::exception_ptr error_;
  bool begun_ = false, ended_ = false;
  ucontext_t inside_{}, outside_{};
};

template <class Real>
class StockWalk : public Walk {
 public:
  StockWalk(const Traversal<Real>& traversal, WalkStack stack)
      : Walk(
            [](const void* t, void* data, NearCallback* callback) {
              (*static_cast<const Traversal<Real>*>(t))(data, callback);
            },
            &traversal, std::move(stack)) {}
};

}  // namespace harpoon::ode
