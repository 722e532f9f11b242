// What records.hpp says of a contact in numbers: how long normals are, where squares underflow and
// overflow, what exchanging the bodies changes. Bits are judged elsewhere (device.ode_oracle).

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "harpoon/device.hpp"

namespace harpoon {
namespace {

constexpr double kDegrees = 57.29577951308232;

// The worst of 2000 pairs in random directions.
struct Worst {
  double length = 0;  ///< of | |normal| - 1 |
  double degrees = 0;
  int grazing = 0;
};

template <class Real>
Worst worst_at(double distance) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  Worst worst;
  for (int i = 0; i < 2000; ++i) {
    const double x = normal(engine);
    const double y = normal(engine);
    const double z = normal(engine);
    const double length = std::sqrt(x * x + y * y + z * z);
    const double scale = distance / length;
    const auto c = collide(SpherePairOf<Real>{
        {Real(x * scale), Real(y * scale), Real(z * scale), 1}, {0, 0, 0, Real(0.5)}});
    if (c.flow() == Flow::grazing) {
      ++worst.grazing;
      continue;
    }
    EXPECT_EQ(c.flow(), Flow::real);
    const double n[3] = {c.normal[0], c.normal[1], c.normal[2]};
    const double n_length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const double cosine = (n[0] * x + n[1] * y + n[2] * z) / (length * n_length);
    worst.length = std::max(worst.length, std::abs(n_length - 1));
    worst.degrees = std::max(worst.degrees, std::acos(std::min(1.0, cosine)) * kDegrees);
  }
  return worst;
}

TEST(Normals, AreUnitLengthWhereSquaresDoNotUnderflow) {
  for (const double distance : {1e-3, 1e-6, 1e-10, 1e-15, 1e-18, 3e-19}) {
    const Worst worst = worst_at<float>(distance);
    EXPECT_LT(worst.length, 2e-7) << distance;
    EXPECT_LT(worst.degrees, 1e-5) << distance;
    EXPECT_EQ(worst.grazing, 0) << distance;
  }
  for (const double distance : {1e-3, 1e-20, 1e-100, 1e-150}) {
    const Worst worst = worst_at<double>(distance);
    EXPECT_LT(worst.length, 4e-16) << distance;
    EXPECT_LT(worst.degrees, 1e-5) << distance;
    EXPECT_EQ(worst.grazing, 0) << distance;
  }
}

// Beside the upper limits that records.hpp states, lower ones: the exception is there.
TEST(Normals, AreOffByWhatIsSaidWhereSquaresUnderflow) {
  const struct {
    double distance, least, most;
  } f32[] = {{1e-20, 5e-6, 1e-5},
             {1e-21, 5e-4, 1e-3},
             {3e-22, 5e-3, 0.01},
             {1e-22, 0.05, 0.1},
             {3e-23, 0.1, 0.2}},
    f64[] = {{1e-160, 1e-4, 3e-4}, {3e-162, 0.2, 0.36}};
  for (const auto& row : f32) {
    const Worst worst = worst_at<float>(row.distance);
    EXPECT_GT(worst.length, row.least) << row.distance;
    EXPECT_LT(worst.length, row.most) << row.distance;
    EXPECT_LT(worst.degrees, 1e-5) << row.distance;
  }
  for (const auto& row : f64) {
    const Worst worst = worst_at<double>(row.distance);
    EXPECT_GT(worst.length, row.least) << row.distance;
    EXPECT_LT(worst.length, row.most) << row.distance;
    EXPECT_LT(worst.degrees, 1e-5) << row.distance;
  }
  EXPECT_EQ(worst_at<float>(2e-23).grazing, 2000);
  EXPECT_EQ(worst_at<double>(1e-162).grazing, 2000);
}

TEST(Contacts, EndWhereSquaresOverflow) {
  EXPECT_EQ(collide(SpherePair{{0, 0, 0, 1e19F}, {1.8e19F, 0, 0, 1e19F}}).flow(), Flow::real);
  EXPECT_EQ(collide(SpherePair{{0, 0, 0, 1e20F}, {1.9e19F, 0, 0, 1e20F}}).flow(), Flow::fake);
  EXPECT_EQ(collide(SpherePairF64{{0, 0, 0, 1e154}, {1.3e154, 0, 0, 1e154}}).flow(), Flow::real);
  EXPECT_EQ(collide(SpherePairF64{{0, 0, 0, 1e155}, {1.4e154, 0, 0, 1e155}}).flow(), Flow::fake);
}

template <class Real>
void expect_exchange(double position_limit) {
  std::mt19937_64 engine(2);
  const auto uniform = [&](double low, double high) {
    return Real(std::uniform_real_distribution<double>(low, high)(engine));
  };
  int hits = 0;
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto sphere = [&] {
      const Real r = Real(std::pow(10, uniform(-3, 1)));
      return SphereOf<Real>{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), r};
    };
    const SpherePairOf<Real> pair{sphere(), sphere()};
    const auto a = collide(pair);
    const auto b = collide(SpherePairOf<Real>{pair.s2, pair.s1});
    ASSERT_EQ(a.flow(), b.flow());
    if (!a.hit()) continue;
    ++hits;
    EXPECT_EQ(a.depth, b.depth);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(a.normal[k], -b.normal[k]);
      worst = std::max(worst, std::abs(double(a.pos[k]) - double(b.pos[k])) /
                                  (double(pair.s1.r) + double(pair.s2.r)));
    }
  }
  EXPECT_GT(hits, 1000);
  EXPECT_LT(worst, position_limit);
}

TEST(Contacts, OfExchangedBodiesHaveTheOppositeNormal) {
  expect_exchange<float>(4e-7);
  expect_exchange<double>(8e-16);
}

TEST(Contacts, OfADiagonalPairHaveTheRightDepth) {
  const Contact c = collide(SpherePair{{0.08F, 0.06F, 0.06F, 0.08F}, {0, 0, 0, 0.10F}});
  EXPECT_NEAR(c.depth, 0.18 - std::sqrt(0.0136), 1e-7);
}

}  // namespace
}  // namespace harpoon
