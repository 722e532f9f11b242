#include <gtest/gtest.h>

#include <cfenv>
#include <stdexcept>
#include <thread>

#include "base/float_environment.hpp"
#include "harpoon/device.hpp"
#include "support/pairs.hpp"

namespace harpoon {
namespace {

std::unique_ptr<Device> cpu(CpuOptions options = {}) {
  auto device = make_cpu_device(options);
  EXPECT_TRUE(device);
  return std::move(*device);
}

/// Runs tasks on threads of its own, last task first.
void backwards(std::size_t tasks, const std::function<void(std::size_t)>& body) {
  std::thread worker([&] {
    for (std::size_t i = tasks / 2; i-- > 0;) body(i);
  });
  for (std::size_t i = tasks; i-- > tasks / 2;) body(i);
  worker.join();
}

void expect_right(Device& device, std::size_t count) {
  const auto pairs = test::random_pairs<float>(count, count);
  std::vector<Contact> contacts(count);
  const auto outcome = device.run(PairBatch<float>{pairs, contacts});
  ASSERT_TRUE(outcome) << outcome.error().message;
  std::uint64_t hits = 0;
  for (std::size_t i = 0; i < count; ++i) {
    ASSERT_TRUE(test::same_contact(contacts[i], test::algorithm_1(pairs[i]))) << i;
    hits += contacts[i].hit() ? 1 : 0;
  }
  EXPECT_EQ(outcome->pairs, count);
  EXPECT_EQ(outcome->hits, hits);
  EXPECT_FALSE(outcome->modelled_ns);
}

TEST(CpuDevice, IsNamedAndDoesEverything) {
  const auto device = cpu();
  EXPECT_EQ(device->name(), "cpu");
  const Capabilities& c = device->capabilities();
  EXPECT_TRUE(c.f32 && c.f64 && c.pair_batches && c.array_batches && c.indexed_batches);
  EXPECT_FALSE(c.modelled);
  EXPECT_FALSE(c.description.empty());
}

TEST(CpuDevice, RunsBatchesOfEverySize) {
  const auto device = cpu();
  for (const std::size_t count : {0U, 1U, 2U, 15U, 16U, 17U, 1000U, 32767U, 32768U, 100001U}) {
    expect_right(*device, count);
  }
}

// Above kStreamBytes the contacts bypass the caches.
TEST(CpuDevice, RunsBatchesLargerThanTheCaches) {
  expect_right(*cpu(), 900001);
}

TEST(CpuDevice, RunsOnAnInjectedParallelFor) {
  for (const unsigned threads : {1u, 2u, 5u}) {
    CpuOptions options;
    options.threads = threads;
    options.parallel_for = backwards;
    expect_right(*cpu(options), 100001);
  }
}

TEST(CpuDevice, ReportsAParallelForThatLosesOrRepeatsTasksOrThrows) {
  const std::pair<const char*, ParallelFor> bad[] = {
      {"loses", [](std::size_t, const auto& body) { body(0); }},
      {"repeats",
       [](std::size_t tasks, const auto& body) {
         for (std::size_t i = 0; i < tasks; ++i) body(i);
         body(0);
       }},
      {"invents",
       [](std::size_t tasks, const auto& body) {
         for (std::size_t i = 0; i <= tasks; ++i) body(i);
       }},
      {"throws", [](std::size_t, const auto&) { throw std::runtime_error("no threads"); }}};
  for (const auto& [what, parallel_for] : bad) {
    CpuOptions options;
    options.threads = 4;
    options.parallel_for = parallel_for;
    const auto pairs = test::random_pairs<float>(1, 100000);
    std::vector<Contact> contacts(pairs.size());
    const auto outcome = cpu(options)->run(PairBatch<float>{pairs, contacts});
    ASSERT_FALSE(outcome) << what;
    EXPECT_EQ(outcome.error().code, Errc::executor_failed) << what;
  }
}

TEST(CpuDevice, RefusesOptionsItCannotMeet) {
  CpuOptions options;
  options.threads = 5000;
  EXPECT_EQ(make_cpu_device(options).error().code, Errc::invalid_argument);
  options = {};
  options.instruction_set = "MMX";
  const auto device = make_cpu_device(options);
  ASSERT_FALSE(device);
  EXPECT_NE(device.error().message.find("MMX"), std::string::npos);
  EXPECT_NE(device.error().message.find(cpu_instruction_sets().back()), std::string::npos);
}

TEST(CpuDevice, ReportsABadBatchAndTouchesNothing) {
  const auto device = cpu();
  const auto pairs = test::random_pairs<float>(3, 100);
  std::vector<Contact> contacts(99, Contact{{9, 9, 9}, {9, 9, 9}, 9, 9});
  const auto outcome = device->run(PairBatch<float>{pairs, contacts});
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, Errc::capacity);
  EXPECT_EQ(outcome.error().needed, 100u);
  for (const Contact& c : contacts) EXPECT_EQ(c.flow_word, 9u);
}

// The caller's rounding mode, flush-to-zero and flags neither matter nor change.
TEST(CpuDevice, IgnoresAndKeepsTheCallersFloatingPointEnvironment) {
  const auto pairs = test::random_pairs<float>(4, 50000);
  std::vector<Contact> expected(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) expected[i] = test::algorithm_1(pairs[i]);
  const auto device = cpu();
  std::vector<Contact> contacts(pairs.size());

  std::fesetround(FE_UPWARD);
  std::feclearexcept(FE_ALL_EXCEPT);
#if defined(__SSE2__)
  const unsigned before = _mm_getcsr() | 0x8040;  // FTZ and DAZ
  _mm_setcsr(before);
#endif
  const auto outcome = device->run(PairBatch<float>{pairs, contacts});
  const Contact single = collide(pairs[0]);
#if defined(__SSE2__)
  const unsigned after = _mm_getcsr();
  _mm_setcsr(before & ~0x8040u);
#endif
  const int rounding = std::fegetround();
  const int flags = std::fetestexcept(FE_ALL_EXCEPT);
  std::fesetround(FE_TONEAREST);

  ASSERT_TRUE(outcome);
  EXPECT_EQ(rounding, FE_UPWARD);
  EXPECT_EQ(flags, 0);
#if defined(__SSE2__)
  EXPECT_EQ(after, before);
#endif
  EXPECT_TRUE(test::same_contact(single, expected[0]));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    ASSERT_TRUE(test::same_contact(contacts[i], expected[i])) << i;
  }
}

TEST(CpuDevice, ServesManyThreadsAtOnce) {
  const auto device = cpu();
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] { expect_right(*device, 40000 + t); });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(Collide, SinglePairsEqualAlgorithm1) {
  for (const auto& pair : test::random_pairs<float>(5, 20000)) {
    ASSERT_TRUE(test::same_contact(collide(pair), test::algorithm_1(pair))) << test::text(pair);
  }
  for (const auto& pair : test::random_pairs<double>(6, 20000)) {
    ASSERT_TRUE(test::same_contact(collide(pair), test::algorithm_1(pair))) << test::text(pair);
  }
}

// Swapping the spheres keeps flow and depth and turns the normal round.
TEST(Collide, IsSymmetric) {
  std::size_t real = 0;
  for (const auto& pair : test::random_pairs<double>(8, 20000)) {
    const auto a = collide(pair);
    const auto b = collide(SpherePairF64{pair.s2, pair.s1});
    ASSERT_EQ(a.flow_word, b.flow_word) << test::text(pair);
    if (a.flow() != Flow::real) continue;
    ++real;
    ASSERT_TRUE(test::same_number(a.depth, b.depth)) << test::text(pair);
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(test::same_number(a.normal[i] + 0.0, -b.normal[i] + 0.0)) << test::text(pair);
    }
  }
  EXPECT_GT(real, 4000u);
}

// Moving both spheres by an amount that loses no bits moves the contact only.
TEST(Collide, FollowsAnExactTranslation) {
  test::Random random(9);
  std::size_t real = 0;
  for (int n = 0; n < 20000; ++n) {
    const auto coordinate = [&] { return static_cast<double>(random.below(4096)) / 1024; };
    const SpherePairF64 pair{{coordinate(), coordinate(), coordinate(), 1},
                             {coordinate(), coordinate(), coordinate(), 1.5}};
    SpherePairF64 moved = pair;
    const double by = static_cast<double>(random.below(1024)) - 512;
    for (SphereF64* s : {&moved.s1, &moved.s2}) {
      s->x += by;
      s->y -= by;
      s->z += 2 * by;
    }
    const auto a = collide(pair);
    const auto b = collide(moved);
    ASSERT_EQ(a.flow_word, b.flow_word);
    ASSERT_TRUE(test::same_number(a.depth, b.depth));
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(test::same_number(a.normal[i], b.normal[i]));
    real += a.flow() == Flow::real ? 1 : 0;
  }
  EXPECT_GT(real, 1000u);
}

}  // namespace
}  // namespace harpoon
