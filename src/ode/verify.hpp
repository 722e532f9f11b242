#pragma once

// Comparison with stock: sequences of callbacks and contacts, and the text that names the first
// difference. It never decides what happens then.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ode/frame_file.hpp"
#include "ode/space_record.hpp"
#include "ode/stock_walk.hpp"

namespace harpoon::ode {

/// Called with a difference; the frame is null where the call cannot be repeated from a file.
using Differs = std::function<void(const std::string& difference, const CollisionFrame* frame)>;

/// What a call is compared as.
template <class Real>
struct VerifiedCall {
  std::string_view name;            ///< in messages
  const SpaceRecord<Real>& record;  ///< of the space that is walked over
  Policy policy;
  bool can_be_repeated;  ///< the record's pairs are the call's
};

/// libode's traversal beside a replay: it stands at the pair that the callback is about to see and
/// sees every change that callbacks make, so what it comes to next is what stock would come to.
template <class Real>
class Verifier {
 public:
  /// `stock` outlives it. Nothing runs yet.
  Verifier(const LibodeOf<Real>& ode, const VerifiedCall<Real>& call, const Traversal<Real>& stock,
           WalkStack stack, const Differs& differs)
      : ode_(ode), call_(call), walk_(stock, std::move(stack)), differs_(differs) {}

  /// Before the callback sees a pair.
  void expect(GeomPair ours) { compare(&ours); }
  /// After the last callback.
  void finish() { compare(nullptr); }
  /// The space is gone.
  void abandon();
  /// The walk, at the pair that the callback sees, for a call that is to go on by it; null when it
  /// has ended. There is nothing to compare then: two walks would change things for each other.
  [[nodiscard]] StockWalk<Real>* give_walk() {
    return std::exchange(ended_, true) ? nullptr : &walk_;
  }
  [[nodiscard]] std::uint64_t compared() const { return compared_; }

 private:
  void compare(const GeomPair* ours);
  void report(const GeomPair* ours, const GeomPair* stock);

  const LibodeOf<Real>& ode_;
  const VerifiedCall<Real> call_;
  StockWalk<Real> walk_;
  const Differs& differs_;
  std::vector<GeomPair> seen_;
  std::uint64_t compared_ = 0;
  bool ended_ = false;
};

/// The frame of a difference, for a file.
template <class Real>
[[nodiscard]] CollisionFrame frame_of(const LibodeOf<Real>& ode, const SpaceRecord<Real>& record,
                                      Policy policy, std::span<const GeomPair> stock);

/// What differs and where for the contact of a pair; both null or set. Empty when they are the
/// same.
template <class Real>
[[nodiscard]] std::optional<std::string> compare_contacts(const LibodeOf<Real>& ode, GeomPair pair,
                                                          const ContactGeomOf<Real>* ours,
                                                          const ContactGeomOf<Real>* stock);

}  // namespace harpoon::ode
