// sphere_plane and aabb_overlap, generated and Verilated, against the same colliders over float,
// bit for bit, and against their graphs and pipelines run in C++.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <deque>
#include <span>

#include "Vcolliders.h"
#include "collide/scalar.hpp"
#include "hls/designs.hpp"
#include "rtl/floats.hpp"
#include "sim/coverage.hpp"
#include "verilated.h"

namespace harpoon {
namespace {

using test::as_bits;
using test::as_float;
using test::Random;
using test::same;

constexpr std::uint64_t kSeed = 20260309;
constexpr int kVectors = 500'000;
constexpr int kModelled = 20'000;  // of them, also through the graph and the pipeline in C++

using Words = std::array<std::uint32_t, 12>;
using Outputs = std::vector<std::uint32_t>;

Words random_words(Random& random) {
  Words words{};
  const std::uint32_t kind = test::random_below(random, 4);
  for (std::uint32_t& w : words) {
    w = as_bits(test::random_unit(random));
    if (kind == 1)
      w = as_bits(static_cast<float>(static_cast<int>(test::random_below(random, 5)) - 2));
    if (kind == 2) w = test::any_float(random);
    if (kind == 3)
      w = (w & 0x80ffffffU) | (test::random_below(random, 2) << 23);  // around the subnormals
  }
  if (test::random_below(random, 4) == 0) {  // boxes that do overlap
    for (std::size_t i = 0; i < 3; ++i) {
      words[i] |= 0x80000000U;
      words[3 + i] &= 0x7fffffffU;
      words[6 + i] |= 0x80000000U;
      words[9 + i] &= 0x7fffffffU;
    }
  }
  return words;
}

std::array<float, 12> floats(const Words& words) {
  std::array<float, 12> f{};
  for (std::size_t i = 0; i < 12; ++i) f[i] = as_float(words[i]);
  return f;
}

Outputs scalar_plane(const Words& words) {
  const std::array<float, 12> f = floats(words);
  const auto c =
      colliders::sphere_plane<float>({{f[0], f[1], f[2]}, f[3], {f[4], f[5], f[6]}, f[7]});
  return {as_bits(c.pos.x),    as_bits(c.pos.y),    as_bits(c.pos.z), as_bits(c.normal.x),
          as_bits(c.normal.y), as_bits(c.normal.z), as_bits(c.depth), c.hit};
}

Outputs scalar_overlap(const Words& words) {
  const std::array<float, 12> f = floats(words);
  return {colliders::aabb_overlap<float>({{f[0], f[1], f[2]}, {f[3], f[4], f[5]}},
                                         {{f[6], f[7], f[8]}, {f[9], f[10], f[11]}})};
}

void expect_same(const Outputs& got, const Outputs& want) {
  ASSERT_EQ(got.size(), want.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_TRUE(same(got[i], want[i]))
        << "output " << i << " is " << std::hex << got[i] << ", not " << want[i];
  }
}

/// One collider's three hardware forms, each compared with the scalar one, `latency` cycles late.
class Checker {
 public:
  Checker(const hls::Graph& graph, Outputs (*scalar)(const Words&))
      : pipeline_(hls::make_pipeline(graph)), model_(pipeline_), scalar_(scalar) {}

  [[nodiscard]] std::size_t latency() const {
    return static_cast<std::size_t>(pipeline_.schedule.latency);
  }

  /// Before the clock edge that takes `words` in.
  void enter(const Words& words) {
    const std::size_t inputs = pipeline_.graph.inputs().size();
    under_way_.push_back(scalar_(words));
    if (++count_ > kModelled) return;
    const auto used = std::span(words).first(inputs);
    expect_same(hls::evaluate(pipeline_.graph, used), under_way_.back());
    const Outputs out = model_.step(used);
    if (under_way_.size() > latency()) {
      expect_same(out, under_way_[under_way_.size() - 1 - latency()]);
    }
  }

  /// After that edge.
  void leave(const Outputs& verilated) {
    if (under_way_.size() < latency()) return;
    expect_same(verilated, under_way_[under_way_.size() - latency()]);
    ++(under_way_[under_way_.size() - latency()].back() ? hits_ : misses_);
    if (under_way_.size() > latency() + 1) under_way_.pop_front();
  }

  [[nodiscard]] int hits() const { return hits_; }
  [[nodiscard]] int misses() const { return misses_; }

 private:
  hls::Pipeline pipeline_;
  hls::PipelineModel model_;
  Outputs (*scalar_)(const Words&);
  std::deque<Outputs> under_way_;
  int count_ = 0;
  int hits_ = 0;
  int misses_ = 0;
};

Outputs words_of(const VlWide<7>& wide, bool hit) {
  Outputs out(8);
  std::memcpy(out.data(), &wide, 7 * sizeof(std::uint32_t));
  out[7] = hit;
  return out;
}

TEST(GeneratedColliders, EqualTheScalarOnes) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  Random random(kSeed);
  VerilatedContext context;
  Vcolliders top{&context};
  const auto clock = [&] {
    top.clk_i = 0;
    top.eval();
    top.clk_i = 1;
    top.eval();
  };
  top.rst_ni = 0;
  clock();
  top.rst_ni = 1;
  Checker plane(hls::design_sphere_plane().graph, scalar_plane);
  Checker overlap(hls::design_aabb_overlap().graph, scalar_overlap);
  for (int i = 0; i < kVectors && !HasFailure(); ++i) {
    const Words words = random_words(random);
    plane.enter(words);
    overlap.enter(words);
    std::memcpy(&top.words_i, words.data(), sizeof words);
    clock();
    plane.leave(words_of(top.plane_o, top.plane_hit_o));
    overlap.leave({top.overlap_o});
  }
  for (const Checker* checker : {&plane, &overlap}) {
    EXPECT_GT(checker->hits(), kVectors / 20);
    EXPECT_GT(checker->misses(), kVectors / 20);
  }
  sim::write_coverage(context);
}

}  // namespace
}  // namespace harpoon
