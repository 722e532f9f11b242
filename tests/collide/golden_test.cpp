// The scalar collider's bits are the same from every compiler and at every optimisation level: one
// hash over many pairs of every flow, kept here. It changes only when the arithmetic does.

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "harpoon/device.hpp"

namespace harpoon {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers on every machine and library.
class Random {
 public:
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, 1), a multiple of 2^-24.
  double unit() { return static_cast<double>(bits() >> 40) * 0x1p-24; }

 private:
  std::uint64_t state_ = 20110501;
};

/// FNV-1a over the bytes of a record.
template <class Record>
void add(std::uint64_t& hash, const Record& record) {
  unsigned char bytes[sizeof(Record)];
  std::memcpy(bytes, &record, sizeof(Record));
  for (const unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001B3u;
}

/// Spheres around the origin so that all flows occur; every tenth pair has one centre.
template <class Real>
SpherePairOf<Real> random_pair(Random& random) {
  const auto sphere = [&] {
    return SphereOf<Real>{
        static_cast<Real>(4 * random.unit() - 2), static_cast<Real>(4 * random.unit() - 2),
        static_cast<Real>(4 * random.unit() - 2), static_cast<Real>(2 * random.unit())};
  };
  SpherePairOf<Real> pair{sphere(), sphere()};
  if (random.bits() % 10 == 0) {
    pair.s2.x = pair.s1.x;
    pair.s2.y = pair.s1.y;
    pair.s2.z = pair.s1.z;
  }
  return pair;
}

template <class Real>
std::uint64_t hash_of_contacts() {
  Random random;
  std::uint64_t hash = 0xCBF29CE484222325u;
  int seen[4] = {};
  for (int i = 0; i < 100000; ++i) {
    const ContactOf<Real> contact = collide(random_pair<Real>(random));
    add(hash, contact);
    ++seen[contact.flow_word & 3];
  }
  for (const Flow flow : {Flow::fake, Flow::grazing, Flow::real}) {
    EXPECT_GT(seen[static_cast<int>(flow)], 5000);
  }
  return hash;
}

TEST(CollideGolden, Float) {
  EXPECT_EQ(hash_of_contacts<float>(), 4154078136401156753u);
}
TEST(CollideGolden, Double) {
  EXPECT_EQ(hash_of_contacts<double>(), 3592928881434803454u);
}

}  // namespace
}  // namespace harpoon
