#pragma once

// The arithmetic of the cpu device: one table of functions per instruction set, all giving the same
// bits. The functions trust their arguments, run on the calling thread and expect the contract's
// floating-point environment (base/float_environment.hpp).

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "harpoon/records.hpp"

namespace harpoon::cpu {

template <class Real>
struct KernelsOf {
  /// Writes one contact per pair; returns the number of hits. `stream` writes around the caches.
  std::size_t (*pairs)(const SpherePairOf<Real>* pairs, std::size_t count,
                       ContactOf<Real>* contacts, bool stream);
  /// The same on separate arrays, for the records [begin, end).
  std::size_t (*arrays)(const SpherePairArraysOf<Real>& pairs, std::size_t begin, std::size_t end,
                        const ContactArraysOf<Real>& contacts);
  /// Writes the contacts of the pairs that touch, in their order, as far as there is `room`;
  /// returns the number of all hits.
  std::size_t (*collide_hits)(const SphereOf<Real>* spheres, const IndexPair* pairs,
                              std::size_t count, BodyContactOf<Real>* contacts, std::size_t room);
  /// For threads, which must know their places in the output first: writes the positions in
  /// pairs[0, count) of the pairs that touch, ascending, to `hits`, which has room for `count`;
  /// returns their number.
  std::size_t (*find_hits)(const SphereOf<Real>* spheres, const IndexPair* pairs, std::size_t count,
                           std::uint32_t* hits);
  /// Writes the contacts of the `count` pairs named by `hits`, all of which touch.
  void (*fill_hits)(const SphereOf<Real>* spheres, const IndexPair* pairs,
                    const std::uint32_t* hits, std::size_t count, BodyContactOf<Real>* contacts);
};

struct Kernels {
  KernelsOf<float> f32;
  KernelsOf<double> f64;
  /// The largest index in the pairs; 0 when there are none.
  std::uint32_t (*max_index)(const IndexPair* pairs, std::size_t count);

  template <class Real>
  [[nodiscard]] const KernelsOf<Real>& of() const noexcept {
    if constexpr (sizeof(Real) == 4) {
      return f32;
    } else {
      return f64;
    }
  }
};

/// Names of the instruction sets that this build holds and this machine runs, narrowest first.
std::vector<std::string> instruction_set_names();

/// The name of the widest of them. Static storage.
std::string_view widest_instruction_set() noexcept;

/// The kernels of a named instruction set, or of the widest when the name is empty; null when this
/// machine or this build lacks it. Static storage.
const Kernels* find_kernels(std::string_view instruction_set) noexcept;

}  // namespace harpoon::cpu
