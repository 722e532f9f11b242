#pragma once

// The oracle: the single-pair collider on all pairs, and the filter rules written out again.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include "harpoon/device.hpp"
#include "harpoon/scene.hpp"

namespace harpoon::testing {

inline bool pair_counts(const Filters& f, std::size_t a, std::size_t b) {
  if (!f.category.empty()) {
    const bool ode = ((f.category[a] & f.collide[b]) != 0) || ((f.category[b] & f.collide[a]) != 0);
    if (!ode) return false;
  }
  if (!f.owner.empty() && f.owner[a] != 0 && f.owner[a] == f.owner[b]) return false;
  if (!f.rest.empty() && f.rest[a] != Rest::awake && f.rest[b] != Rest::awake) return false;
  return true;
}

template <class Real>
bool usable(const SphereOf<Real>& s) {
  for (const Real v : {s.x, s.y, s.z, s.r}) {
    if (!std::isfinite(v) || std::abs(v) > kSceneLimit<Real>) return false;
  }
  return s.r >= 0;
}

/// All contacts in ascending order of ids.
template <class Real>
std::vector<BodyContactOf<Real>> brute_force(std::span<const SphereOf<Real>> spheres,
                                             const Filters& filters = {}) {
  std::vector<BodyContactOf<Real>> out;
  for (std::uint32_t a = 0; a < spheres.size(); ++a) {
    if (!usable(spheres[a])) continue;
    for (std::uint32_t b = a + 1; b < spheres.size(); ++b) {
      if (!usable(spheres[b]) || !pair_counts(filters, a, b)) continue;
      const ContactOf<Real> c = harpoon::collide(SpherePairOf<Real>{spheres[a], spheres[b]});
      if (!c.hit()) continue;
      out.push_back(
          {{c.pos[0], c.pos[1], c.pos[2]}, {c.normal[0], c.normal[1], c.normal[2]}, c.depth, a, b});
    }
  }
  return out;
}

/// All overlapping pairs of closed boxes in ascending order of ids. A box with a NaN or a min
/// beyond its max is in none.
template <class Real>
std::vector<IndexPair> overlapping(const std::vector<std::array<Real, 6>>& boxes,
                                   const Filters& filters = {}) {
  const auto usable_box = [](const std::array<Real, 6>& b) {
    return b[0] <= b[1] && b[2] <= b[3] && b[4] <= b[5];
  };
  std::vector<IndexPair> out;
  for (std::uint32_t a = 0; a < boxes.size(); ++a) {
    if (!usable_box(boxes[a])) continue;
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b) {
      bool apart = !usable_box(boxes[b]) || !pair_counts(filters, a, b);
      for (std::size_t k = 0; k < 6; k += 2) {
        apart = apart || boxes[a][k] > boxes[b][k + 1] || boxes[b][k] > boxes[a][k + 1];
      }
      if (!apart) out.push_back({a, b});
    }
  }
  return out;
}

inline std::vector<IndexPair> sorted_by_ids(std::vector<IndexPair> pairs) {
  std::sort(pairs.begin(), pairs.end(), [](const IndexPair& a, const IndexPair& b) {
    return a.g1 != b.g1 ? a.g1 < b.g1 : a.g2 < b.g2;
  });
  return pairs;
}

template <class Real>
std::vector<BodyContactOf<Real>> sorted_by_ids(std::vector<BodyContactOf<Real>> contacts) {
  std::sort(contacts.begin(), contacts.end(),
            [](const auto& a, const auto& b) { return a.g1 != b.g1 ? a.g1 < b.g1 : a.g2 < b.g2; });
  return contacts;
}

template <class Real>
bool same_bits(const std::vector<BodyContactOf<Real>>& a,
               const std::vector<BodyContactOf<Real>>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

/// FNV-1a over the bytes of records without padding.
template <class T>
std::uint64_t hash_of(std::span<const T> records, std::uint64_t hash = 0xCBF29CE484222325U) {
  const auto bytes = std::as_bytes(records);
  for (const std::byte b : bytes) hash = (hash ^ static_cast<std::uint64_t>(b)) * 0x100000001B3U;
  return hash;
}

}  // namespace harpoon::testing
