#include "ode/sphere_contacts.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

namespace harpoon::ode {
namespace {

constexpr std::size_t kFirstBlock = 64;
constexpr std::size_t kSmallestBlock = 8;
constexpr std::size_t kLargestBlock = 512;
/// Whose contacts are kept from frame to frame while nothing changes: 64 MB in binary64.
constexpr std::size_t kMostKeptPairs = std::size_t{1} << 20;

}  // namespace

template <class Real>
void SphereContacts<Real>::reset() {
  begin_ = end_ = cursor_ = next_ = 0;
  asked_ = 0;
  single_spheres_valid_ = false;
}

template <class Real>
void SphereContacts<Real>::rewind(bool once_more) {
  keeps_all_ = once_more;
  if (begin_ == 0) cursor_ = next_ = 0;
}

template <class Real>
std::size_t SphereContacts<Real>::next_size(const ContactSource& source, std::size_t pairs) const {
  if (source.whole_frames || (keeps_all_ && pairs <= kMostKeptPairs)) return pairs;
  if (size_ == 0) return kFirstBlock;
  const std::size_t last = end_ - begin_;
  if (asked_ * 2 >= last) return std::min(size_ * 2, kLargestBlock);
  if (asked_ * 4 < last) return std::max(size_ / 2, kSmallestBlock);
  return size_;
}

template <class Real>
template <class Number>
bool SphereContacts<Real>::run(Device& device, std::span<const SphereOf<Number>> spheres,
                               std::span<const IndexPair> pairs,
                               std::vector<BodyContactOf<Number>>& contacts) {
  // Room for one more: the mark behind the last.
  if (contacts.size() <= pairs.size()) contacts.resize(pairs.size() + 1);
  const Result<Outcome> outcome = device.run(IndexedBatch<Number>{spheres, pairs, contacts});
  hits_ = outcome ? outcome->hits : 0;
  return outcome.ok();
}

/// The contacts of `pairs` in binary32, widened.
template <class Real>
bool SphereContacts<Real>::run_single(Device& device, std::span<const SphereOf<Real>> spheres,
                                      std::span<const IndexPair> pairs) {
  if (!single_spheres_valid_) {
    single_spheres_.resize(spheres.size());
    std::transform(spheres.begin(), spheres.end(), single_spheres_.begin(), [](const auto& s) {
      return SphereOf<float>{static_cast<float>(s.x), static_cast<float>(s.y),
                             static_cast<float>(s.z), static_cast<float>(s.r)};
    });
    single_spheres_valid_ = true;
  }
  const bool done =
      run(device, std::span<const SphereOf<float>>(single_spheres_), pairs, single_contacts_);
  contacts_.resize(single_contacts_.size());
  for (std::size_t k = 0; k < hits_; ++k) {
    const BodyContactOf<float>& c = single_contacts_[k];
    contacts_[k] = {{c.pos[0], c.pos[1], c.pos[2]},
                    {c.normal[0], c.normal[1], c.normal[2]},
                    c.depth,
                    c.g1,
                    c.g2};
  }
  return done;
}

/// The block's pairs of spheres: themselves where all are, else a copy.
template <class Real>
std::span<const IndexPair> SphereContacts<Real>::pick(const Mirror<Real>& mirror,
                                                      std::span<const IndexPair> block) {
  if (mirror.only_spheres) return block;
  sphere_pairs_.clear();
  for (const IndexPair pair : block) {
    if (mirror.are_spheres(pair)) sphere_pairs_.push_back(pair);
  }
  return sphere_pairs_;
}

template <class Real>
void SphereContacts<Real>::load(const ContactSource& source, const Mirror<Real>& mirror,
                                std::span<const IndexPair> pairs, std::size_t k) {
  size_ = next_size(source, pairs.size());
  begin_ = size_ == pairs.size() ? 0 : k;
  end_ = std::min(begin_ + size_, pairs.size());
  cursor_ = begin_;
  next_ = 0;
  asked_ = 0;

  const std::span<const IndexPair> sphere_pairs =
      pick(mirror, pairs.subspan(begin_, end_ - begin_));
  const std::span<const SphereOf<Real>> spheres = mirror.spheres;
  const bool widen = source.single_precision && !std::is_same_v<Real, float>;
  failed_ = !(widen ? run_single(*source.device, spheres, sphere_pairs)
                    : run(*source.device, spheres, sphere_pairs, contacts_));
  // A mark behind the last, which is that of no pair.
  contacts_[hits_].g1 = contacts_[hits_].g2 = ~0u;
}

namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): the self-test's numbers.
class Numbers {
 public:
  /// Uniform in [0, 1).
  double unit() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_ = 0x0DE;
};

template <class Real>
SphereOf<Real> some_sphere(Numbers& numbers) {
  const auto coordinate = [&] { return static_cast<Real>(numbers.unit() * 2 - 1); };
  return {coordinate(), coordinate(), coordinate(), static_cast<Real>(numbers.unit() + 0.1)};
}

template <class Real>
bool same_bits(const Real* a, const Real* b, std::size_t count) {
  return std::memcmp(static_cast<const void*>(a), static_cast<const void*>(b), count * sizeof *a) ==
         0;
}

}  // namespace

template <class Real>
bool spheres_agree(const LibodeOf<Real>& ode, Device& device) {
  constexpr std::uint32_t kPairs = 256;
  Numbers numbers;
  std::vector<SphereOf<Real>> spheres(2 * kPairs);
  std::vector<IndexPair> pairs(kPairs);
  for (std::uint32_t k = 0; k < kPairs; ++k) {
    spheres[2 * k] = some_sphere<Real>(numbers);
    spheres[2 * k + 1] = k % 16 == 0 ? spheres[2 * k] : some_sphere<Real>(numbers);
    pairs[k] = {2 * k, 2 * k + 1};
  }
  std::vector<BodyContactOf<Real>> contacts(kPairs);
  const Result<Outcome> outcome = device.run(IndexedBatch<Real>{spheres, pairs, contacts});
  if (!outcome) return false;

  bool agree = true;
  std::size_t next = 0;
  for (std::uint32_t k = 0; k < kPairs && agree; ++k) {
    dxGeom* geoms[2];
    for (std::uint32_t side = 0; side < 2; ++side) {
      const SphereOf<Real>& sphere = spheres[2 * k + side];
      geoms[side] = ode.create_sphere(nullptr, sphere.r);
      ode.geom_set_position(geoms[side], sphere.x, sphere.y, sphere.z);
    }
    ContactGeomOf<Real> stock{};
    const int count = ode.collide(geoms[0], geoms[1], 1, &stock, sizeof stock);
    const bool hit = next < outcome->hits && contacts[next].g1 == 2 * k;
    agree = (count == 1) == hit;
    if (agree && hit) {
      const BodyContactOf<Real>& ours = contacts[next];
      agree = same_bits(ours.pos, stock.pos, 3) && same_bits(ours.normal, stock.normal, 3) &&
              same_bits(&ours.depth, &stock.depth, 1);
    }
    next += hit ? 1 : 0;
    for (dxGeom* geom : geoms) ode.geom_destroy(geom);
  }
  return agree;
}

template class SphereContacts<float>;
template class SphereContacts<double>;
template bool spheres_agree(const LibodeOf<float>&, Device&);
template bool spheres_agree(const LibodeOf<double>&, Device&);

}  // namespace harpoon::ode
