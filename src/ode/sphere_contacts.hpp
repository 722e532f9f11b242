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

  /// What `find` gives where there is no contact.
  static constexpr std::int32_t kNone = -1;   ///< not a pair of spheres, or the device failed
  static constexpr std::int32_t kApart = -2;  ///< spheres that do not touch

  /// The place of the contact of pair number `k` of `pairs` in `contact`, or one of the above.
  std::int32_t find(const ContactSource& source, const Mirror<Real>& mirror,
                    std::span<const IndexPair> pairs, std::size_t k) {
    if (k < begin_ || k >= end_) load(source, mirror, pairs, k);
    ++asked_;
    return contact_of_[k - begin_];
  }
  /// Valid until the next call of `find`.
  [[nodiscard]] const BodyContactOf<Real>& contact(std::int32_t place) const {
    return contacts_[static_cast<std::size_t>(place)];
  }

 private:
  void load(const ContactSource& source, const Mirror<Real>& mirror,
            std::span<const IndexPair> pairs, std::size_t begin);
  [[nodiscard]] std::size_t next_size(const ContactSource& source, std::size_t pairs) const;
  std::span<const IndexPair> pick(const Mirror<Real>& mirror, std::span<const IndexPair> block);
  template <class Number>
  [[nodiscard]] bool run(Device& device, std::span<const SphereOf<Number>> spheres,
                         std::span<const IndexPair> pairs,
                         std::vector<BodyContactOf<Number>>& contacts);
  [[nodiscard]] bool run_single(Device& device, std::span<const SphereOf<Real>> spheres,
                                std::span<const IndexPair> pairs);

  std::size_t begin_ = 0, end_ = 0;       ///< the block
  std::size_t asked_ = 0;                 ///< questions about it
  std::size_t size_ = 0;                  ///< its size, 0: not known yet
  std::vector<std::int32_t> contact_of_;  ///< by pair of the block
  std::vector<IndexPair> sphere_pairs_;
  std::vector<BodyContactOf<Real>> contacts_;  ///< `hits_` of them and a mark
  std::uint64_t hits_ = 0;
  std::vector<BodyContactOf<float>> single_contacts_;
  std::vector<SphereOf<float>> single_spheres_;
  bool single_spheres_valid_ = false;
};

/// Whether the device's contacts of spheres have the bits of libode's own collider, by trying it on
/// pairs of every kind. False when not (a libode built with contraction) or when the device fails.
template <class Real>
[[nodiscard]] bool spheres_agree(const LibodeOf<Real>& ode, Device& device);

}  // namespace harpoon::ode
