// The scpu and its miss test, Verilated, against the scalar collider, bit for bit; and the graph
// they were generated from, evaluated in C++, against both.

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <deque>

#include "Vscpu_and_cull.h"
#include "harpoon/device.hpp"
#include "hls/designs.hpp"
#include "rtl/floats.hpp"
#include "verilated.h"

namespace harpoon {
namespace {

using test::any_float;
using test::as_bits;
using test::as_float;
using test::Random;
using test::same;

constexpr std::uint64_t kSeed = 20260307;
constexpr int kPairs = 2'000'000;

using Words = std::array<std::uint32_t, 8>;

enum class Kind { overlapping, touching, coincident, lattice, subnormal, any, count };
constexpr std::size_t kKinds = static_cast<std::size_t>(Kind::count);

/// A pair of the given kind; `any` has all exponents, infinities and NaNs.
Words make_pair(Random& random, Kind kind) {
  std::array<float, 8> f{};
  for (float& x : f) x = test::random_unit(random);
  f[3] = 0.6F + 0.5F * f[3];
  f[7] = 0.6F + 0.5F * f[7];
  if (kind == Kind::touching) {  // along x, within a few steps of touching
    f[5] = f[1];
    f[6] = f[2];
    const std::uint32_t steps = test::random_below(random, 5);
    f[4] = as_float(as_bits(f[0] + (f[3] + f[7])) + steps - 2);
  } else if (kind == Kind::coincident) {
    for (std::size_t i = 0; i < 3; ++i) f[4 + i] = f[i];
    if (test::random_below(random, 4) == 0) f[3] = f[7] = 0;
  } else if (kind == Kind::lattice) {  // small integers: distances are often exactly r1 + r2
    for (float& x : f) x = static_cast<float>(test::random_below(random, 5));
  }
  Words words{};
  for (std::size_t i = 0; i < 8; ++i) words[i] = as_bits(f[i]);
  if (kind == Kind::subnormal) {
    for (std::uint32_t& w : words) w = (w & 0x80000fffU) | test::random_below(random, 0x40) << 18;
  } else if (kind == Kind::any) {
    for (std::uint32_t& w : words) w = any_float(random);
    if (test::random_below(random, 2)) {  // of similar size, so that the radii matter
      const std::uint32_t exponent = test::random_below(random, 255);
      for (std::uint32_t& w : words) w = (w & 0x807fffffU) | (exponent ^ (w >> 23 & 1)) << 23;
      words[3] &= 0x7fffffffU;
      words[7] &= 0x7fffffffU;
    }
  }
  return words;
}

Words scalar_contact(const Words& pair) {
  const Contact contact = collide(std::bit_cast<SpherePair>(pair));
  return std::bit_cast<Words>(contact);
}

void expect_same_contact(const Words& pair, const Words& got, const Words& want) {
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_TRUE(same(got[i], want[i]))
        << "word " << i << std::hex << " is " << got[i] << ", not " << want[i] << ", for the pair "
        << pair[0] << ' ' << pair[1] << ' ' << pair[2] << ' ' << pair[3] << ' ' << pair[4] << ' '
        << pair[5] << ' ' << pair[6] << ' ' << pair[7];
  }
}

class Scpu {
 public:
  Scpu() {
    top_.rst_ni = 0;
    for (int i = 0; i < 4; ++i) clock();
    top_.rst_ni = 1;
  }
  void drive(bool valid, const Words& pair) {
    top_.valid_i = valid;
    std::memcpy(&top_.pair_i, pair.data(), sizeof pair);
  }
  void clock() {
    top_.clk_i = 0;
    top_.eval();
    top_.clk_i = 1;
    top_.eval();
  }
  [[nodiscard]] bool valid() const { return top_.valid_o; }
  [[nodiscard]] bool cull_valid() const { return top_.cull_valid_o; }
  [[nodiscard]] bool miss() const { return top_.miss_o; }
  [[nodiscard]] Words contact() const {
    Words words;
    std::memcpy(words.data(), &top_.contact_o, sizeof words);
    return words;
  }
  void reset(int cycles) {
    top_.rst_ni = 0;
    for (int i = 0; i < cycles; ++i) clock();
    top_.rst_ni = 1;
  }

 private:
  VerilatedContext context_;
  Vscpu_and_cull top_{&context_};
};

int pipeline_latency(const hls::Design& design) {
  return hls::make_pipeline(design.graph).schedule.latency;
}

TEST(Scpu, EqualsTheScalarColliderOnEveryKindOfPair) {
  RecordProperty("seed", std::to_string(kSeed));
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  Random random(kSeed);
  Scpu scpu;
  std::deque<Words> under_way;
  std::deque<Words> being_culled;
  std::array<int, 4> flows{};
  std::array<int, kKinds> kinds{};
  int touching = 0;
  int nan_contacts = 0;
  int bubbles = 0;
  int received = 0;
  int culled = 0;
  for (int sent = 0; received < kPairs && !HasFailure();) {
    const bool send = sent < kPairs && test::random_below(random, 16) != 0;
    Words pair{};
    if (send) {
      const auto kind = static_cast<Kind>(test::random_below(random, kKinds));
      ++kinds[static_cast<std::size_t>(kind)];
      pair = make_pair(random, kind);
      under_way.push_back(pair);
      being_culled.push_back(pair);
      ++sent;
    } else {
      ++bubbles;
    }
    scpu.drive(send, pair);
    scpu.clock();
    if (scpu.cull_valid()) {
      ASSERT_FALSE(being_culled.empty());
      const Words culled_pair = being_culled.front();
      being_culled.pop_front();
      const bool miss = scalar_contact(culled_pair)[7] == static_cast<std::uint32_t>(Flow::fake);
      EXPECT_EQ(scpu.miss(), miss) << "pair " << culled;
      ++culled;
    }
    if (scpu.valid()) {
      ASSERT_FALSE(under_way.empty());
      const Words want = scalar_contact(under_way.front());
      expect_same_contact(under_way.front(), scpu.contact(), want);
      under_way.pop_front();
      ++received;
      ++flows[want[7]];
      touching += want[7] == 3 && as_float(want[6]) == 0;
      nan_contacts += want[7] == 3 && test::is_nan(want[6]);
    }
  }
  EXPECT_EQ(received, kPairs);
  EXPECT_EQ(culled, kPairs);
  EXPECT_EQ(flows[0], 0);
  for (std::size_t flow = 1; flow <= 3; ++flow) EXPECT_GT(flows[flow], kPairs / 100) << flow;
  for (const int count : kinds) EXPECT_GT(count, kPairs / 10);
  EXPECT_GT(touching, 1000);
  EXPECT_GT(nan_contacts, 1000);
  EXPECT_GT(bubbles, 1000);
}

TEST(Scpu, HasTheLatencyOfItsPackage) {
  Scpu scpu;
  Words pair{};
  scpu.drive(true, pair);
  int cycles = 0;
  int cull_cycles = 0;
  while (!scpu.valid() && cycles < 1000) {
    scpu.clock();
    scpu.drive(false, pair);
    ++cycles;
    if (scpu.cull_valid()) cull_cycles = cycles;
  }
  EXPECT_EQ(cycles, pipeline_latency(hls::design_sphere_sphere()) + 1);
  EXPECT_EQ(cull_cycles, pipeline_latency(hls::design_sphere_miss()));
  scpu.clock();
  EXPECT_FALSE(scpu.valid());
}

TEST(Scpu, ResetDropsWhatIsUnderWay) {
  Scpu scpu;
  scpu.drive(true, {});
  for (int i = 0; i < 300; ++i) scpu.clock();
  ASSERT_TRUE(scpu.valid());
  scpu.drive(false, {});
  scpu.reset(1);
  for (int i = 0; i < 300; ++i) {
    EXPECT_FALSE(scpu.valid());
    EXPECT_FALSE(scpu.cull_valid());
    scpu.clock();
  }
}

/// The record that scpu makes of the outputs of its graph: pos, normal, depth, hit, grazing.
Words record(const std::vector<std::uint32_t>& outputs) {
  Words words{0, 0, 0, 0, 0, 0, 0, 1};
  if (outputs[7] == 0) return words;
  std::copy_n(outputs.begin(), 7, words.begin());
  words[7] = outputs[8] ? 2 : 3;
  return words;
}

TEST(Scpu, GraphAndPipelineEqualTheScalarCollider) {
  Random random(kSeed + 1);
  const hls::Pipeline pipeline = hls::make_pipeline(hls::design_sphere_sphere().graph);
  hls::PipelineModel model(pipeline);
  const hls::Graph miss_graph = hls::design_sphere_miss().graph;
  std::deque<Words> under_way;
  std::array<int, 4> flows{};
  for (int i = 0; i < 20'000 && !HasFailure(); ++i) {
    const Words pair = make_pair(random, static_cast<Kind>(test::random_below(random, kKinds)));
    const Words want = scalar_contact(pair);
    ++flows[want[7]];
    expect_same_contact(pair, record(hls::evaluate(pipeline.graph, pair)), want);
    EXPECT_EQ(hls::evaluate(miss_graph, pair)[0], want[7] == 1);
    under_way.push_back(pair);
    const std::vector<std::uint32_t> outputs = model.step(pair);
    if (under_way.size() > static_cast<std::size_t>(pipeline.schedule.latency)) {
      expect_same_contact(under_way.front(), record(outputs), scalar_contact(under_way.front()));
      under_way.pop_front();
    }
  }
  for (std::size_t flow = 1; flow <= 3; ++flow) EXPECT_GT(flows[flow], 200) << flow;
}

}  // namespace
}  // namespace harpoon
