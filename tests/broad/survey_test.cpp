// What a survey takes for the world: most bodies, whatever a few of them do.

#include "broad/survey.hpp"

#include <gtest/gtest.h>

#include "scene/odd_worlds.hpp"

namespace harpoon::testing {
namespace {

constexpr std::uint64_t kSeed = 818;
constexpr int kBodies = 5000;

template <class Real>
class SurveyTest : public ::testing::Test {
 protected:
  static broad::Survey<Real> survey_of(const std::vector<SphereOf<Real>>& spheres) {
    const broad::Means means{{nullptr}, broad::find_kernels("")};
    const SphereOf<Real>* s = spheres.data();
    const broad::Source<Real> source{&s->x, &s->y, &s->z, &s->r, sizeof *s, spheres.size()};
    broad::Survey<Real> out;
    std::vector<std::uint32_t> excluded;
    EXPECT_FALSE(broad::survey(means, source, 0, excluded, out));
    excluded_ = excluded;
    return out;
  }
  static inline std::vector<std::uint32_t> excluded_;
};
using Reals = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SurveyTest, Reals);

TYPED_TEST(SurveyTest, UsualWorldsHaveNoCoreAndNoGiants) {
  using Real = TypeParam;
  for (const World world : {World::gas, World::packed, World::point, World::lattice}) {
    const auto survey = this->survey_of(WorldMaker<Real>(kSeed).make(world, kBodies));
    EXPECT_FALSE(survey.census.bodies_beyond);
    EXPECT_TRUE(survey.giants.empty());
    EXPECT_EQ(survey.census.bodies, static_cast<std::size_t>(kBodies));
  }
}

TYPED_TEST(SurveyTest, BodiesFarAwayAreNotTheWorld) {
  using Real = TypeParam;
  for (const int count : {1, 2, 32, 33, 200}) {
    OddWorldMaker<Real> maker(kSeed);
    auto spheres = maker.usual(kBodies, false);
    const auto alone = this->survey_of(spheres);
    maker.add(spheres, Strays::one_way, count, 1e9);
    const auto survey = this->survey_of(spheres);
    EXPECT_TRUE(survey.census.bodies_beyond) << count;
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(survey.census.min[k], alone.census.min[k]) << count;
      EXPECT_EQ(survey.census.max[k], alone.census.max[k]) << count;
    }
  }
}

TYPED_TEST(SurveyTest, GiantsAreToldFromTheOthers) {
  using Real = TypeParam;
  OddWorldMaker<Real> maker(kSeed);
  auto spheres = maker.usual(kBodies, false);
  spheres[10] = {0, 0, 3000, 2990};
  spheres[4000] = {0, 0, -Real(1e6), 1000};
  spheres[17].r = Real(0.001);
  spheres[18].x = std::numeric_limits<Real>::quiet_NaN();
  const auto survey = this->survey_of(spheres);
  EXPECT_EQ(survey.giants, (std::vector<std::uint32_t>{10, 4000}));
  EXPECT_EQ(this->excluded_, std::vector<std::uint32_t>{18});
  EXPECT_EQ(survey.census.bodies, static_cast<std::size_t>(kBodies) - 3);
  EXPECT_EQ(survey.left_out(), 3U);
  EXPECT_EQ(survey.largest, Real(0.5));
  EXPECT_GT(survey.census.giant_distance, 2800) << "it reaches the world from there";
  EXPECT_LT(survey.census.giant_distance, 3100) << "the other one does not";
}

TYPED_TEST(SurveyTest, ManyLargeBodiesAreNoGiants) {
  using Real = TypeParam;
  OddWorldMaker<Real> maker(kSeed);
  auto spheres = maker.usual(kBodies, false);
  for (std::size_t k = 0; k < spheres.size(); k += 6) spheres[k].r = 40;
  EXPECT_TRUE(this->survey_of(spheres).giants.empty());
}

TYPED_TEST(SurveyTest, EverySecondBodyElsewhereIsHalfTheWorld) {
  using Real = TypeParam;
  std::vector<SphereOf<Real>> spheres;
  for (int k = 0; k < kBodies; ++k) {
    spheres.push_back({k % 2 == 0 ? Real(1e6) : Real(-1e6), static_cast<Real>(k % 71), 0, 1});
  }
  EXPECT_FALSE(this->survey_of(spheres).census.bodies_beyond);
}

}  // namespace
}  // namespace harpoon::testing
