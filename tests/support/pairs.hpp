#pragma once

// Sphere pairs for the differential tests, and the oracle that judges them: Algorithm 1 of the
// paper written out plainly, with its branches.

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "harpoon/records.hpp"
#include "support/random.hpp"

namespace harpoon::test {

/// Algorithm 1, in the paper's words and ODE's order of operations. Independent of src/collide.
template <class Real>
ContactOf<Real> algorithm_1(const SpherePairOf<Real>& pair) {
  using Word = typename ContactOf<Real>::FlowWord;
  const Real p1[3] = {pair.s1.x, pair.s1.y, pair.s1.z};
  const Real p2[3] = {pair.s2.x, pair.s2.y, pair.s2.z};
  const Real r1 = pair.s1.r;
  const Real r2 = pair.s2.r;
  ContactOf<Real> c{};
  const Real tmp[3] = {p1[0] - p2[0], p1[1] - p2[1], p1[2] - p2[2]};
  const Real d = std::sqrt(tmp[0] * tmp[0] + tmp[1] * tmp[1] + tmp[2] * tmp[2]);
  if (d > (r1 + r2)) {
    c.flow_word = static_cast<Word>(Flow::fake);
    return c;
  }
  if (d <= 0) {
    for (int i = 0; i < 3; ++i) c.pos[i] = p1[i];
    c.normal[0] = 1;
    c.depth = r1 + r2;
    c.flow_word = static_cast<Word>(Flow::grazing);
  } else {
    const Real d1 = 1 / d;
    for (int i = 0; i < 3; ++i) c.normal[i] = (p1[i] - p2[i]) * d1;
    const Real k = Real(0.5) * (r2 - r1 - d);
    for (int i = 0; i < 3; ++i) c.pos[i] = p1[i] + c.normal[i] * k;
    c.depth = r1 + r2 - d;
    c.flow_word = static_cast<Word>(Flow::real);
  }
  return c;
}

/// Equal to the bit, except that a NaN equals any NaN (their sign and payload are unspecified).
template <class Real>
bool same_number(Real a, Real b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return std::memcmp(&a, &b, sizeof a) == 0;
}

template <class Contact>
bool same_geometry(const Contact& a, const Contact& b) {
  bool same = same_number(a.depth, b.depth);
  for (int i = 0; i < 3; ++i) {
    same = same && same_number(a.pos[i], b.pos[i]) && same_number(a.normal[i], b.normal[i]);
  }
  return same;
}

template <class Real>
bool same_contact(const ContactOf<Real>& a, const ContactOf<Real>& b) {
  return a.flow_word == b.flow_word && same_geometry(a, b);
}

/// FNV-1a over the bits of a contact, with one representation for all NaNs.
template <class Real>
void add_to_hash(std::uint64_t& hash, const ContactOf<Real>& contact) {
  const auto add = [&](const void* data, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; ++i) {
      hash = (hash ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001B3u;
    }
  };
  const auto add_number = [&](Real x) {
    const Real number = std::isnan(x) ? std::numeric_limits<Real>::quiet_NaN() : x;
    add(&number, sizeof number);
  };
  for (const Real x : contact.pos) add_number(x);
  for (const Real x : contact.normal) add_number(x);
  add_number(contact.depth);
  add(&contact.flow_word, sizeof contact.flow_word);
}

/// A random pair of one of six kinds: around touching, far apart, one centre, on a lattice
/// (touching exactly), tiny differences (the squares underflow), any bit pattern.
template <class Real>
SpherePairOf<Real> random_pair(Random& random) {
  const auto number = [&](double low, double high) {
    return static_cast<Real>(random.between(low, high));
  };
  const auto sphere = [&](double extent) {
    return SphereOf<Real>{number(-extent, extent), number(-extent, extent), number(-extent, extent),
                          number(0, 1)};
  };
  SpherePairOf<Real> pair{sphere(0.7), sphere(0.7)};
  switch (random.below(8)) {
    case 0:
      return {sphere(100), sphere(100)};
    case 1:
      pair.s2 = {pair.s1.x, pair.s1.y, pair.s1.z, pair.s2.r};
      return pair;
    case 2: {
      const auto lattice = [&] {
        return SphereOf<Real>{static_cast<Real>(random.below(3)),
                              static_cast<Real>(random.below(3)),
                              static_cast<Real>(random.below(3)), Real(0.5)};
      };
      return {lattice(), lattice()};
    }
    case 3: {
      const Real tiny = std::numeric_limits<Real>::min() * static_cast<Real>(random.below(1000));
      pair.s1 = {tiny, 0, -tiny, pair.s1.r};
      pair.s2 = {0, tiny, 0, pair.s2.r};
      return pair;
    }
    case 4: {
      std::array<std::uint64_t, sizeof(pair) / 8> words{};
      for (std::uint64_t& word : words) word = random.bits();
      std::memcpy(static_cast<void*>(&pair), words.data(), sizeof pair);
      return pair;
    }
    default:
      return pair;
  }
}

template <class Real>
std::vector<SpherePairOf<Real>> random_pairs(std::uint64_t seed, std::size_t count) {
  Random random(seed);
  std::vector<SpherePairOf<Real>> pairs(count);
  for (SpherePairOf<Real>& pair : pairs) pair = random_pair<Real>(random);
  return pairs;
}

/// The operands to print when a pair fails.
template <class Real>
std::string text(const SpherePairOf<Real>& pair) {
  std::string out;
  Real numbers[8];
  std::memcpy(numbers, &pair, sizeof numbers);
  for (const Real x : numbers) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%a ", static_cast<double>(x));
    out += buffer;
  }
  return out;
}

/// The values whose combinations are tried in every operand.
template <class Real>
inline constexpr std::array<Real, 8> kSpecialValues = {Real(0),
                                                       Real(-0.0),
                                                       std::numeric_limits<Real>::denorm_min(),
                                                       Real(1),
                                                       Real(1e30),
                                                       std::numeric_limits<Real>::max(),
                                                       std::numeric_limits<Real>::infinity(),
                                                       std::numeric_limits<Real>::quiet_NaN()};

}  // namespace harpoon::test
