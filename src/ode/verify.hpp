#pragma once

// Comparison with stock: sequences of callbacks and contacts, and the text that names the first
// difference. It never decides what happens then.

#include <optional>
#include <span>
#include <string>

#include "ode/frame_file.hpp"
#include "ode/space_record.hpp"

namespace harpoon::ode {

/// What differs and where; empty when the replay of `record` and the stock sequence are the same.
template <class Real>
[[nodiscard]] std::optional<std::string> compare_pairs(const LibodeOf<Real>& ode,
                                                       const SpaceRecord<Real>& record,
                                                       std::span<const GeomPair> ours,
                                                       std::span<const GeomPair> stock);

/// The frame of such a difference, for a file.
template <class Real>
[[nodiscard]] CollisionFrame frame_of(const LibodeOf<Real>& ode, const SpaceRecord<Real>& record,
                                      Policy policy, std::span<const GeomPair> stock);

/// The same for the contact of a pair; both null or set.
template <class Real>
[[nodiscard]] std::optional<std::string> compare_contacts(const LibodeOf<Real>& ode, GeomPair pair,
                                                          const ContactGeomOf<Real>* ours,
                                                          const ContactGeomOf<Real>* stock);

}  // namespace harpoon::ode
