#pragma once

// Contacts of a frame's sphere pairs, computed by a device in blocks: the first question about a
// pair computes it together with those that follow it. Blocks grow while the caller asks for most
// of their pairs and shrink when it does not, so pairs that a callback rejects cost little.

#include <cstdint>
#include <span>
#include <vector>

#include "harpoon/device.hpp"
#include "ode/mirror.hpp"

namespace harpoon::ode {

/// Where contacts come from. One for all spaces of an engine.
struct ContactSource {
  Device* device = nullptr;
  /// In binary32, whatever libode's precision.
  bool single_precision = false;
  /// All pairs of a frame in one batch: for devices with a long way to them.
  bool whole_frames = false;
};

template <class Real>
class SphereContacts {
 public:
  /// To be called when the mirror or the pairs have changed.
  void reset();

  enum class Answer : std::uint8_t {
    none,      ///< not a pair of spheres, or the device failed
    apart,     ///< spheres that do not touch
    touching,  ///< `contact` is that of the pair
  };

  /// To be called when a replay begins. Pairs that are replayed once more are worth keeping all
  /// contacts for, up to a limit.
  void rewind(bool once_more);

  /// Whether the block in hand answers for pair number `k`.
  [[nodiscard]] bool has(std::size_t k) const { return k >= cursor_ && k < end_; }

  /// Computes the block that begins with pair number `k`.
  void load(const ContactSource& source, const Mirror<Real>& mirror,
            std::span<const IndexPair> pairs, std::size_t k);

  /// The contact of pair number `k`, which the block `has`. Pairs are asked for in ascending order,
  /// some of them more than once and others never.
  Answer find(const Mirror<Real>& mirror, std::span<const IndexPair> pairs, std::size_t k) {
    ++asked_;
    while (cursor_ < k) next_ += is_next(pairs[cursor_++]) ? 1 : 0;
    if (is_next(pairs[k])) return Answer::touching;
    const bool known = !failed_ && (mirror.only_spheres || mirror.are_spheres(pairs[k]));
    return known ? Answer::apart : Answer::none;
  }
  [[nodiscard]] const BodyContactOf<Real>& contact() const { return contacts_[next_]; }

 private:
  [[nodiscard]] bool is_next(IndexPair pair) const {
    return contacts_[next_].g1 == pair.g1 && contacts_[next_].g2 == pair.g2;
  }
  [[nodiscard]] std::size_t next_size(const ContactSource& source, std::size_t pairs) const;
  std::span<const IndexPair> pick(const Mirror<Real>& mirror, std::span<const IndexPair> block);
  template <class Number>
  [[nodiscard]] bool run(Device& device, std::span<const SphereOf<Number>> spheres,
                         std::span<const IndexPair> pairs,
                         std::vector<BodyContactOf<Number>>& contacts);
  [[nodiscard]] bool run_single(Device& device, std::span<const SphereOf<Real>> spheres,
                                std::span<const IndexPair> pairs);

  std::size_t begin_ = 0, end_ = 0;  ///< the block
  std::size_t cursor_ = 0;           ///< the pair last asked for
  std::size_t next_ = 0;             ///< in `contacts_`: the first of a pair from the cursor on
  std::size_t asked_ = 0;            ///< questions about the block
  std::size_t size_ = 0;             ///< its size, 0: not known yet
  std::vector<IndexPair> sphere_pairs_;
  std::vector<BodyContactOf<Real>> contacts_;  ///< `hits_` of them and a mark
  std::uint64_t hits_ = 0;
  bool failed_ = false;
  bool keeps_all_ = false;
  std::vector<BodyContactOf<float>> single_contacts_;
  std::vector<SphereOf<float>> single_spheres_;
  bool single_spheres_valid_ = false;
};

/// Whether the device's contacts of spheres have the bits of libode's own collider, by trying it on
/// pairs of every kind. False when not (a libode built with contraction) or when the device fails.
template <class Real>
[[nodiscard]] bool spheres_agree(const LibodeOf<Real>& ode, Device& device);

}  // namespace harpoon::ode
