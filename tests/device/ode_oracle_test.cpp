// Stock ODE as the oracle: the f64 contact of a pair equals dCollide's bit for bit.

#include <gtest/gtest.h>
#include <ode/ode.h>

#include "harpoon/device.hpp"
#include "support/pairs.hpp"

namespace harpoon {
namespace {

constexpr std::uint64_t kSeed = 20260101;
constexpr std::size_t kPairs = 10'000'000;
constexpr std::size_t kBlock = 100'000;

class Ode : public testing::Test {
 protected:
  Ode() {
    dInitODE2(0);
    first_ = dCreateSphere(nullptr, 1);
    second_ = dCreateSphere(nullptr, 1);
  }
  ~Ode() override {
    dGeomDestroy(first_);
    dGeomDestroy(second_);
    dCloseODE();
  }

  /// ODE's assertions stop the process at a negative or NaN radius.
  static bool accepts(const SpherePairF64& pair) { return pair.s1.r >= 0 && pair.s2.r >= 0; }

  ContactF64 stock(const SpherePairF64& pair) {
    dGeomSphereSetRadius(first_, pair.s1.r);
    dGeomSphereSetRadius(second_, pair.s2.r);
    dGeomSetPosition(first_, pair.s1.x, pair.s1.y, pair.s1.z);
    dGeomSetPosition(second_, pair.s2.x, pair.s2.y, pair.s2.z);
    dContactGeom geometry{};
    ContactF64 contact{};
    if (dCollide(first_, second_, 1, &geometry, sizeof geometry) == 0) {
      contact.flow_word = static_cast<std::uint64_t>(Flow::fake);
      return contact;
    }
    for (int i = 0; i < 3; ++i) {
      contact.pos[i] = geometry.pos[i];
      contact.normal[i] = geometry.normal[i];
    }
    contact.depth = geometry.depth;
    return contact;  // ODE does not say which flow a hit was
  }

  void compare(const std::vector<SpherePairF64>& pairs) {
    std::vector<ContactF64> contacts(pairs.size());
    const auto outcome = (*device_)->run(PairBatch<double>{pairs, contacts});
    ASSERT_TRUE(outcome) << outcome.error().message;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const ContactF64 expected = stock(pairs[i]);
      ASSERT_EQ(contacts[i].hit(), expected.flow() != Flow::fake) << test::text(pairs[i]);
      ASSERT_TRUE(test::same_geometry(contacts[i], expected)) << test::text(pairs[i]);
      ++seen_[static_cast<std::size_t>(contacts[i].flow())];
    }
  }

  void expect_seen(std::size_t least) const {
    for (const Flow flow : {Flow::fake, Flow::grazing, Flow::real}) {
      EXPECT_GT(seen_[static_cast<std::size_t>(flow)], least) << static_cast<int>(flow);
    }
  }

  Result<std::unique_ptr<Device>> device_ = make_cpu_device();
  std::array<std::size_t, 4> seen_{};
  dGeomID first_;
  dGeomID second_;
};

TEST_F(Ode, AgreesOnTenMillionRandomPairs) {
  test::Random random(kSeed);
  std::vector<SpherePairF64> pairs;
  for (std::size_t done = 0; done < kPairs; done += kBlock) {
    pairs.clear();
    while (pairs.size() < kBlock) {
      auto pair = test::random_pair<double>(random);
      pair.s1.r = std::abs(pair.s1.r);
      pair.s2.r = std::abs(pair.s2.r);
      if (accepts(pair)) pairs.push_back(pair);
    }
    ASSERT_NO_FATAL_FAILURE(compare(pairs)) << "seed " << kSeed;
  }
  expect_seen(kPairs / 100);
}

// Special values in all eight operands, as far as ODE's assertions let them in.
TEST_F(Ode, AgreesOnAllCombinationsOfSpecialValues) {
  std::vector<SpherePairF64> pairs;
  std::size_t total = 0;
  for (std::size_t combination = 0; combination < (std::size_t{1} << 24); ++combination) {
    double numbers[8];
    for (std::size_t k = 0; k < 8; ++k) {
      numbers[k] = test::kSpecialValues<double>[(combination >> (3 * k)) % 8];
    }
    SpherePairF64 pair;
    std::memcpy(static_cast<void*>(&pair), numbers, sizeof numbers);
    if (accepts(pair)) pairs.push_back(pair);
    if (pairs.size() == kBlock) {
      ASSERT_NO_FATAL_FAILURE(compare(pairs));
      total += pairs.size();
      pairs.clear();
    }
  }
  ASSERT_NO_FATAL_FAILURE(compare(pairs));
  EXPECT_EQ(total + pairs.size(), std::size_t{7} * 7 * (std::size_t{1} << 18));
  expect_seen(10000);
}

}  // namespace
}  // namespace harpoon
