// Indexed batches against a plain loop of Algorithm 1, serial and in tasks.

#include "device/cpu/indexed_batch.hpp"

#include <gtest/gtest.h>

#include "support/pairs.hpp"

namespace harpoon {
namespace {

template <class Real>
struct Scene {
  std::vector<SphereOf<Real>> spheres;
  std::vector<IndexPair> pairs;
  std::vector<BodyContactOf<Real>> expected;
};

template <class Real>
Scene<Real> random_scene(std::uint64_t seed, std::size_t spheres, std::size_t pairs) {
  test::Random random(seed);
  Scene<Real> scene;
  for (std::size_t i = 0; i < spheres; ++i) {
    const auto at = [&] { return static_cast<Real>(random.between(-1, 1)); };
    scene.spheres.push_back({at(), at(), at(), static_cast<Real>(random.between(0, 0.6))});
  }
  for (std::size_t i = 0; i < pairs; ++i) {
    const IndexPair pair{static_cast<std::uint32_t>(random.below(spheres)),
                         static_cast<std::uint32_t>(random.below(spheres))};
    scene.pairs.push_back(pair);
    const ContactOf<Real> c =
        test::algorithm_1<Real>({scene.spheres[pair.g1], scene.spheres[pair.g2]});
    if (!c.hit()) continue;
    scene.expected.push_back({{c.pos[0], c.pos[1], c.pos[2]},
                              {c.normal[0], c.normal[1], c.normal[2]},
                              c.depth,
                              pair.g1,
                              pair.g2});
  }
  return scene;
}

template <class Real>
class Indexed : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(Indexed, Precisions);

template <class Real>
void expect_prefix(const Scene<Real>& scene, const std::vector<BodyContactOf<Real>>& contacts,
                   std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    ASSERT_TRUE(test::same_geometry(contacts[i], scene.expected[i])) << i;
    ASSERT_EQ(contacts[i].g1, scene.expected[i].g1) << i;
    ASSERT_EQ(contacts[i].g2, scene.expected[i].g2) << i;
  }
}

TYPED_TEST(Indexed, WritesTheHitsInPairOrder) {
  for (const std::string& name : cpu_instruction_sets()) {
    for (const std::size_t pairs :
         {0U, 1U, 7U, 8U, 17U, 1000U, 1024U, 1025U, 8192U, 30003U, 200003U}) {
      const auto scene = random_scene<TypeParam>(pairs, 500, pairs);
      CpuOptions options;
      options.instruction_set = name;
      options.threads = 1 + static_cast<unsigned>(pairs % 3);
      const auto device = make_cpu_device(options);
      std::vector<BodyContactOf<TypeParam>> contacts(scene.expected.size());
      const auto outcome =
          (*device)->run(IndexedBatch<TypeParam>{scene.spheres, scene.pairs, contacts});
      ASSERT_TRUE(outcome) << outcome.error().message;
      EXPECT_EQ(outcome->hits, scene.expected.size());
      EXPECT_EQ(outcome->pairs, pairs);
      expect_prefix(scene, contacts, contacts.size());
      if (pairs > 1000) {
        EXPECT_GT(contacts.size(), pairs / 20);
        EXPECT_LT(contacts.size(), pairs * 9 / 10);
      }
    }
  }
}

TYPED_TEST(Indexed, AFullOutputHoldsTheFirstHitsAndTheErrorSaysHowManyThereAre) {
  for (const std::size_t pairs : {100U, 100000U, 100001U}) {
    CpuOptions options;
    options.threads = 1 + static_cast<unsigned>(pairs % 2);
    const auto device = make_cpu_device(options);
    const auto scene = random_scene<TypeParam>(pairs, 300, pairs);
    for (const std::size_t room :
         {std::size_t{0}, scene.expected.size() / 2, scene.expected.size() - 1}) {
      std::vector<BodyContactOf<TypeParam>> contacts(room);
      const auto outcome =
          (*device)->run(IndexedBatch<TypeParam>{scene.spheres, scene.pairs, contacts});
      ASSERT_FALSE(outcome);
      EXPECT_EQ(outcome.error().code, Errc::capacity);
      EXPECT_EQ(outcome.error().needed, scene.expected.size());
      expect_prefix(scene, contacts, room);
    }
  }
}

TYPED_TEST(Indexed, ABadIndexIsNamedAndNothingIsWritten) {
  const auto device = make_cpu_device();
  for (const std::size_t pairs : {10U, 50000U}) {
    auto scene = random_scene<TypeParam>(5, 64, pairs);
    scene.pairs[pairs - 3].g2 = 64;
    std::vector<BodyContactOf<TypeParam>> contacts(pairs);
    const auto outcome =
        (*device)->run(IndexedBatch<TypeParam>{scene.spheres, scene.pairs, contacts});
    ASSERT_FALSE(outcome);
    EXPECT_EQ(outcome.error().code, Errc::invalid_index);
    EXPECT_NE(outcome.error().message.find("pair " + std::to_string(pairs - 3)), std::string::npos)
        << outcome.error().message;
    EXPECT_NE(outcome.error().message.find("64"), std::string::npos);
    for (const auto& c : contacts) ASSERT_EQ(c.g1 + c.g2, 0u);
  }
}

TEST(Indexed, ABodyWithItselfIsAGrazingCollision) {
  const std::vector<Sphere> spheres{{1, 2, 3, 0.5F}};
  const std::vector<IndexPair> pairs{{0, 0}};
  std::vector<BodyContact> contacts(1);
  const auto device = make_cpu_device();
  ASSERT_TRUE((*device)->run(IndexedBatch<float>{spheres, pairs, contacts}));
  EXPECT_EQ(contacts[0].pos[2], 3);
  EXPECT_EQ(contacts[0].normal[0], 1);
  EXPECT_EQ(contacts[0].depth, 1);
}

}  // namespace
}  // namespace harpoon
