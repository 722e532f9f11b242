// One source for every instruction set: Highway compiles this file once per target. Indexed pairs
// are first gathered into records, a block at a time, so that the memory system sees many
// independent loads; from there on they are pairs like any other.

#include "device/cpu/kernels.hpp"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "device/cpu/kernels.cpp"
#include "hwy/cache_control.h"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "base/instruction_set.hpp"
#include "collide/copy_sphere.inl"
#include "collide/simd.inl"
#include "device/cpu/records.inl"

HWY_BEFORE_NAMESPACE();
namespace harpoon::cpu::HWY_NAMESPACE {
namespace {

template <class Real>
using Number = simd::SimdReal<Tag<Real>>;
template <class Real>
using Word = typename ContactOf<Real>::FlowWord;

constexpr std::size_t kMaxLanes = HWY_MAX_BYTES / sizeof(float);

/// The fields of N contacts; zero where the pair does not touch.
template <class Real, class Mask>
HWY_INLINE Fields<Real> contact_fields(const simd::ContactResult<Number<Real>, Mask>& c) {
  const Tag<Real> d;
  const hn::RebindToUnsigned<Tag<Real>> du;
  const auto word = [&](Flow flow) HWY_ATTR {
    return hn::BitCast(d, hn::Set(du, static_cast<Word<Real>>(flow)));
  };
  const auto flow =
      hn::IfThenElse(c.hit.m, hn::IfThenElse(c.grazing.m, word(Flow::grazing), word(Flow::real)),
                     word(Flow::fake));
  const auto if_hit = [&](const Number<Real>& x)
                          HWY_ATTR { return hn::IfThenElseZero(c.hit.m, x.v); };
  return {{if_hit(c.pos.x), if_hit(c.pos.y), if_hit(c.pos.z), if_hit(c.normal.x)},
          {if_hit(c.normal.y), if_hit(c.normal.z), if_hit(c.depth), flow}};
}

/// One vector of pairs between its two halves of work.
template <class Real>
struct Halfway {
  simd::Vec3<Number<Real>> p1;
  simd::Separation<Number<Real>> separation;
};

template <class Real>
HWY_INLINE Halfway<Real> begin_vector(const SpherePairOf<Real>* pairs) {
  Args<Real> s1;
  Args<Real> s2;
  load_pairs(pairs, s1, s2);
  return {s1.p, simd::separation(s1, s2)};
}

/// Writes the contacts; returns the number of hits.
template <class Real>
HWY_INLINE std::size_t finish_vector(const Halfway<Real>& h, ContactOf<Real>* contacts) {
  const auto c = simd::contact(h.p1, h.separation);
  store_fields<Real>(contact_fields<Real>(c), contacts->pos);
  return hn::CountTrue(Tag<Real>(), c.hit.m);
}

/// Contacts of `vectors` whole vectors of pairs; returns the number of hits. The first half of each
/// is done before the second half of the one ahead of it: the chain from a load through square root
/// and division to a store is longer than a processor looks ahead.
template <class Real>
HWY_INLINE std::size_t collide_vectors(const SpherePairOf<Real>* pairs, std::size_t vectors,
                                       ContactOf<Real>* contacts) {
  if (vectors == 0) return 0;
  const std::size_t lanes = hn::Lanes(Tag<Real>());
  std::size_t hits = 0;
  Halfway<Real> current = begin_vector(pairs);
  for (std::size_t i = 1; i < vectors; ++i) {
    pairs += lanes;
    const Halfway<Real> next = begin_vector(pairs);
    hits += finish_vector(current, contacts);
    contacts += lanes;
    current = next;
  }
  return hits + finish_vector(current, contacts);
}

/// Fills the rest of a vector with pairs that do not touch.
template <class Real>
HWY_INLINE void pad_with_misses(SpherePairOf<Real>* begin, const SpherePairOf<Real>* end) {
  for (; begin < end; ++begin) *begin = {{0, 0, 0, 0}, {1, 0, 0, 0}};
}

/// Contacts of fewer pairs than a vector holds.
template <class Real>
HWY_INLINE std::size_t collide_short(const SpherePairOf<Real>* pairs, std::size_t count,
                                     ContactOf<Real>* contacts) {
  SpherePairOf<Real> in[kMaxLanes];
  ContactOf<Real> out[kMaxLanes];
  const std::size_t lanes = hn::Lanes(Tag<Real>());
  std::memcpy(in, pairs, count * sizeof in[0]);
  pad_with_misses(in + count, in + lanes);
  const std::size_t hits = collide_vectors(in, 1, out);
  std::memcpy(contacts, out, count * sizeof out[0]);
  return hits;
}

template <class Real>
HWY_INLINE std::size_t pairs_cached(const SpherePairOf<Real>* pairs, std::size_t count,
                                    ContactOf<Real>* contacts) {
  const std::size_t lanes = hn::Lanes(Tag<Real>());
  const std::size_t whole = count - count % lanes;
  const std::size_t hits = collide_vectors(pairs, count / lanes, contacts);
  if (whole == count) return hits;
  if (whole == 0) return collide_short(pairs, count, contacts);
  // The last vector overlaps the one before it, which writes the same contacts again.
  collide_vectors(pairs + count - lanes, 1, contacts + count - lanes);
  return hits +
         static_cast<std::size_t>(std::count_if(contacts + whole, contacts + count,
                                                [](const ContactOf<Real>& c) { return c.hit(); }));
}

/// Writes `bytes`, a multiple of the line, to `to`, which is line-aligned, around the caches.
HWY_INLINE void stream_lines(const unsigned char* from, std::size_t bytes, unsigned char* to) {
  const hn::ScalableTag<std::uint8_t> d;
  for (std::size_t i = 0; i < bytes; i += hn::Lanes(d)) {
    hn::Stream(hn::LoadU(d, from + i), d, to + i);
  }
}

constexpr std::uintptr_t kPage = 4096;

/// The place in `area`, which has a page to spare, that is a quarter of a page from `pairs` in the
/// bits of an address below a page (blocks of f32 lie half a page apart, so that is the middle). By
/// these bits processors tell loads from the stores before them: where both lie at the same ones,
/// loads of pairs wait for stores of contacts that they have nothing to do with.
HWY_INLINE unsigned char* apart_from(const void* pairs, unsigned char* area,
                                     std::size_t alignment) {
  const std::uintptr_t wanted = reinterpret_cast<std::uintptr_t>(pairs) + kPage / 4;
  const std::uintptr_t shift = (wanted - reinterpret_cast<std::uintptr_t>(area)) % kPage;
  return area + shift / alignment * alignment;
}

/// Called for every block of output in turn, touches each page of it once, a page ahead. A store
/// around the caches asks for the translation of its page only when its turn comes, and nothing
/// looks over the end of a page for it: untouched, every page costs a walk of the page table.
template <std::uintptr_t block_bytes>
HWY_INLINE void touch_next_page(const unsigned char* block) {
  const auto at = reinterpret_cast<std::uintptr_t>(block);
  if (at % kPage < block_bytes) hwy::Prefetch(reinterpret_cast<const char*>(at + kPage));
}

/// Blocks of contacts are made in a buffer and sent on in whole cache lines. Where the output does
/// not start on a line, the buffer holds the skew: the bytes that share a line with the next block.
///
///   buffer  [ ... skew bytes | block of contacts ................. ]
///                ^ sent from here, as many bytes as the block has; the rest is the next skew
///
/// Not inlined: small batches would pay for its large frame.
template <class Real>
HWY_NOINLINE std::size_t pairs_streamed(const SpherePairOf<Real>* pairs, std::size_t count,
                                        ContactOf<Real>* contacts) {
  constexpr std::size_t kLine = 64;
  constexpr std::size_t kBlock = 4 * kMaxLanes;
  constexpr std::size_t kBlockBytes = kBlock * sizeof(ContactOf<Real>);
  constexpr std::size_t kHead = kLine / sizeof(ContactOf<Real>);
  if (count < kHead + kBlock) return pairs_cached(pairs, count, contacts);

  std::size_t hits = pairs_cached(pairs, kHead, contacts);
  std::size_t i = kHead;
  auto* to = reinterpret_cast<unsigned char*>(contacts + i);
  const std::size_t skew = reinterpret_cast<std::uintptr_t>(to) % kLine;
  HWY_ALIGN unsigned char area[kLine + kBlockBytes + kPage];
  unsigned char* const buffer = apart_from(pairs + i, area, kLine);
  auto* const block = reinterpret_cast<ContactOf<Real>*>(buffer + kLine);
  unsigned char* const begin = buffer + kLine - skew;
  std::memcpy(begin, to - skew, skew);
  for (; i + kBlock <= count; i += kBlock, to += kBlockBytes) {
    touch_next_page<kBlockBytes>(to);
    hits += collide_vectors(pairs + i, kBlock / hn::Lanes(Tag<Real>()), block);
    stream_lines(begin, kBlockBytes, to - skew);
    std::memcpy(begin, begin + kBlockBytes, skew);
  }
  hwy::FlushStream();
  std::memcpy(to - skew, begin, skew);
  return hits + pairs_cached(pairs + i, count - i, contacts + i);
}

template <class Real>
std::size_t collide_pairs(const SpherePairOf<Real>* pairs, std::size_t count,
                          ContactOf<Real>* contacts, bool stream) {
  return stream ? pairs_streamed(pairs, count, contacts) : pairs_cached(pairs, count, contacts);
}

template <class Real>
HWY_INLINE void store_arrays(const Fields<Real>& f, const ContactArraysOf<Real>& c, std::size_t i) {
  const Tag<Real> d;
  const hn::RebindToUnsigned<Tag<Real>> du;
  hn::StoreU(f.first.a, d, c.pos_x + i);
  hn::StoreU(f.first.b, d, c.pos_y + i);
  hn::StoreU(f.first.c, d, c.pos_z + i);
  hn::StoreU(f.first.d, d, c.normal_x + i);
  hn::StoreU(f.second.a, d, c.normal_y + i);
  hn::StoreU(f.second.b, d, c.normal_z + i);
  hn::StoreU(f.second.c, d, c.depth + i);
  hn::StoreU(hn::BitCast(du, f.second.d), du, c.flow + i);
}

/// One pair of arrays, by way of a record.
template <class Real>
HWY_INLINE std::size_t collide_array_element(const SpherePairArraysOf<Real>& p, std::size_t i,
                                             const ContactArraysOf<Real>& c) {
  const SpherePairOf<Real> pair{{p.x1[i], p.y1[i], p.z1[i], p.r1[i]},
                                {p.x2[i], p.y2[i], p.z2[i], p.r2[i]}};
  ContactOf<Real> contact;
  const std::size_t hits = collide_short(&pair, 1, &contact);
  c.pos_x[i] = contact.pos[0];
  c.pos_y[i] = contact.pos[1];
  c.pos_z[i] = contact.pos[2];
  c.normal_x[i] = contact.normal[0];
  c.normal_y[i] = contact.normal[1];
  c.normal_z[i] = contact.normal[2];
  c.depth[i] = contact.depth;
  c.flow[i] = contact.flow_word;
  return hits;
}

template <class Real>
std::size_t collide_arrays(const SpherePairArraysOf<Real>& p, std::size_t begin, std::size_t end,
                           const ContactArraysOf<Real>& c) {
  const Tag<Real> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t hits = 0;
  std::size_t i = begin;
  for (; i + lanes <= end; i += lanes) {
    const auto at = [&](const Real* array)
                        HWY_ATTR { return Number<Real>(hn::LoadU(d, array + i)); };
    const Args<Real> s1{{at(p.x1), at(p.y1), at(p.z1)}, at(p.r1)};
    const Args<Real> s2{{at(p.x2), at(p.y2), at(p.z2)}, at(p.r2)};
    const auto result = simd::sphere_sphere<Number<Real>>(s1, s2);
    store_arrays(contact_fields<Real>(result), c, i);
    hits += hn::CountTrue(d, result.hit.m);
  }
  for (; i < end; ++i) hits += collide_array_element(p, i, c);
  return hits;
}

/// Pairs gathered at a time: enough loads under way to hide the latency of memory, few enough that
/// the records stay in the first-level cache.
constexpr std::size_t kGatherBlock = 128;

/// Which of one vector of pairs touch, one bit a lane (see pair_of_lane).
template <class Real>
HWY_INLINE std::uint64_t hit_lanes(const simd::Separation<Number<Real>>& separation) {
  std::uint8_t bytes[kMaxLanes / 8 + sizeof(std::uint64_t)] = {};
  hn::StoreMaskBits(Tag<Real>(), simd::touches(separation).m, bytes);
  std::uint64_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

/// Calls `use(lane)` for every bit that is set, ascending.
template <class Use>
HWY_INLINE void for_each_lane(std::uint64_t bits, const Use& use) {
  for (; bits != 0; bits &= bits - 1) use(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
}

template <class Real>
HWY_INLINE void copy_contact(const ContactOf<Real>& from, const IndexPair& pair,
                             BodyContactOf<Real>& to) {
  std::memcpy(static_cast<void*>(&to), &from, 7 * sizeof(Real));
  to.g1 = pair.g1;
  to.g2 = pair.g2;
}

/// Where in memory the pair of each lane lies, from the first of its vector.
template <class Real>
struct Slots {
  HWY_INLINE Slots() {
    for (std::size_t lane = 0; lane < hn::Lanes(Tag<Real>()); ++lane) {
      of_lane[lane] = pair_of_lane<Real>(lane);
    }
  }
  std::size_t of_lane[kMaxLanes];
};

/// Copies `count` pairs so that lane k of a vector of them is pair k.
template <class Real>
HWY_INLINE void gather_in_lane_order(const SphereOf<Real>* spheres, const IndexPair* pairs,
                                     std::size_t count, const Slots<Real>& slots,
                                     SpherePairOf<Real>* block) {
  const std::size_t lanes = hn::Lanes(Tag<Real>());
  for (std::size_t first = 0; first < count; first += lanes) {
    const std::size_t used = std::min(lanes, count - first);
    for (std::size_t lane = 0; lane < used; ++lane) {
      SpherePairOf<Real>& to = block[first + slots.of_lane[lane]];
      simd::copy_sphere(spheres[pairs[first + lane].g1], to.s1);
      simd::copy_sphere(spheres[pairs[first + lane].g2], to.s2);
    }
    for (std::size_t lane = used; lane < lanes; ++lane) {
      SpherePairOf<Real>& to = block[first + slots.of_lane[lane]];
      pad_with_misses(&to, &to + 1);
    }
  }
}

template <class Real>
std::size_t collide_hits(const SphereOf<Real>* spheres, const IndexPair* pairs, std::size_t count,
                         BodyContactOf<Real>* contacts, std::size_t room) {
  const std::size_t lanes = hn::Lanes(Tag<Real>());
  const Slots<Real> slots;
  HWY_ALIGN SpherePairOf<Real> block[kGatherBlock + kMaxLanes];
  ContactOf<Real> out[kMaxLanes];
  std::size_t found = 0;
  for (std::size_t base = 0; base < count; base += kGatherBlock) {
    const std::size_t size = std::min(kGatherBlock, count - base);
    gather_in_lane_order(spheres, pairs + base, size, slots, block);
    for (std::size_t k = 0; k < size; k += lanes) {
      const Halfway<Real> halfway = begin_vector(block + k);
      const std::uint64_t bits = hit_lanes<Real>(halfway.separation);
      if (bits == 0) continue;
      finish_vector(halfway, out);
      for_each_lane(bits, [&](std::size_t lane) HWY_ATTR {
        if (found < room) {
          copy_contact(out[slots.of_lane[lane]], pairs[base + k + lane], contacts[found]);
        }
        ++found;
      });
    }
  }
  return found;
}

template <class Real>
std::size_t find_hits(const SphereOf<Real>* spheres, const IndexPair* pairs, std::size_t count,
                      std::uint32_t* hits) {
  const std::size_t lanes = hn::Lanes(Tag<Real>());
  const Slots<Real> slots;
  HWY_ALIGN SpherePairOf<Real> block[kGatherBlock + kMaxLanes];
  std::size_t found = 0;
  for (std::size_t base = 0; base < count; base += kGatherBlock) {
    const std::size_t size = std::min(kGatherBlock, count - base);
    gather_in_lane_order(spheres, pairs + base, size, slots, block);
    for (std::size_t k = 0; k < size; k += lanes) {
      for_each_lane(hit_lanes<Real>(begin_vector(block + k).separation),
                    [&](std::size_t lane)
                        HWY_ATTR { hits[found++] = static_cast<std::uint32_t>(base + k + lane); });
    }
  }
  return found;
}

template <class Real>
void fill_hits(const SphereOf<Real>* spheres, const IndexPair* pairs, const std::uint32_t* hits,
               std::size_t count, BodyContactOf<Real>* contacts) {
  SpherePairOf<Real> in[kGatherBlock];
  ContactOf<Real> out[kGatherBlock];
  for (std::size_t base = 0; base < count; base += kGatherBlock) {
    const std::size_t size = std::min(kGatherBlock, count - base);
    for (std::size_t k = 0; k < size; ++k) {
      const IndexPair& pair = pairs[hits[base + k]];
      simd::copy_sphere(spheres[pair.g1], in[k].s1);
      simd::copy_sphere(spheres[pair.g2], in[k].s2);
    }
    pairs_cached(in, size, out);
    for (std::size_t k = 0; k < size; ++k) {
      copy_contact(out[k], pairs[hits[base + k]], contacts[base + k]);
    }
  }
}

std::uint32_t max_index(const IndexPair* pairs, std::size_t count) {
  std::uint32_t largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    largest = std::max(largest, std::max(pairs[i].g1, pairs[i].g2));
  }
  return largest;
}

template <class Real>
constexpr KernelsOf<Real> kKernelsOf = {collide_pairs<Real>, collide_arrays<Real>,
                                        collide_hits<Real>, find_hits<Real>, fill_hits<Real>};

const Kernels* get_kernels() {
  static constexpr Kernels kKernels = {kKernelsOf<float>, kKernelsOf<double>, max_index};
  return &kKernels;
}

}  // namespace
}  // namespace harpoon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace harpoon::cpu {
namespace {

HWY_EXPORT(get_kernels);

}  // namespace

std::vector<std::string> instruction_set_names() {
  std::vector<std::string> names;
  for (std::int64_t rest = usable_targets(); rest != 0; rest &= rest - 1) {
    names.emplace_back(name_of_target(rest & -rest));
  }
  std::reverse(names.begin(), names.end());
  return names;
}

std::string_view widest_instruction_set() noexcept {
  return name_of_target(find_target({}));
}

const Kernels* find_kernels(std::string_view instruction_set) noexcept {
  const std::int64_t target = find_target(instruction_set);
  return target == 0 ? nullptr : call_for_target(HWY_DISPATCH_TABLE(get_kernels), target);
}

}  // namespace harpoon::cpu
#endif
