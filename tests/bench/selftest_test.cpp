#include "bench/selftest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/fake_devices.hpp"
#include "bench/pair_cases.hpp"

namespace harpoon::bench {
namespace {

SelftestPlan plan_for(std::shared_ptr<Device> device) {
  SelftestPlan plan;
  plan.devices = {{"tested", 1, std::move(device)}};
  plan.oracles = {{"oracle", [](const SpherePairF64& pair) { return algorithm1(pair); }}};
  plan.pairs = 20000;
  return plan;
}

std::vector<std::string> failures(const std::vector<SelftestCheck>& checks) {
  std::vector<std::string> failed;
  for (const SelftestCheck& check : checks) {
    if (!check.passed()) {
      failed.push_back(check.form + " " + check.against);
    }
  }
  return failed;
}

TEST(Selftest, ARightDevicePassesAllNineChecks) {
  int seen = 0;
  const auto checks = run_selftest(plan_for(std::make_shared<PlainDevice>()),
                                   [&](const SelftestCheck&) { ++seen; });
  EXPECT_EQ(checks.size(), 9U);
  EXPECT_EQ(seen, 9);
  EXPECT_TRUE(failures(checks).empty()) << checks[0].first_mismatch;
}

TEST(Selftest, AWrongLastBitIsFoundInEveryForm) {
  PlainDevice::Spoiler spoiler;
  spoiler.f64 = [](std::size_t, ContactF64& contact) {
    if (contact.depth > 0.5 && contact.depth < 0.6) {
      contact.depth = std::nextafter(contact.depth, 1.0);
    }
  };
  EXPECT_EQ(failures(run_selftest(plan_for(std::make_shared<PlainDevice>(spoiler)))),
            (std::vector<std::string>{"records f64 = Algorithm 1", "arrays f64 = Algorithm 1",
                                      "indexed f64 = Algorithm 1", "records f64 = oracle",
                                      "arrays f64 = oracle", "indexed f64 = oracle"}));
}

TEST(Selftest, OneWrongContactIsNamed) {
  PlainDevice::Spoiler spoiler;
  spoiler.f64 = [](std::size_t i, ContactF64& contact) {
    if (i == 8000) {  // an overlapping pair
      contact.depth = std::nextafter(contact.depth, 1e9);
    }
  };
  const auto checks = run_selftest(plan_for(std::make_shared<PlainDevice>(spoiler)));
  const auto arrays = std::find_if(checks.begin(), checks.end(), [](const SelftestCheck& check) {
    return check.form == "arrays" && !check.passed();
  });
  ASSERT_NE(arrays, checks.end());
  EXPECT_EQ(arrays->mismatches, 1U);
  EXPECT_NE(arrays->first_mismatch.find("pair 8000"), std::string::npos) << arrays->first_mismatch;
}

TEST(Selftest, AMinusZeroIsNotAZero) {
  PlainDevice::Spoiler spoiler;
  spoiler.f32 = [](std::size_t, Contact& contact) {
    if (contact.flow() == Flow::fake) {
      contact.pos[0] = -0.0F;
    }
  };
  const auto checks = run_selftest(plan_for(std::make_shared<PlainDevice>(spoiler)));
  EXPECT_EQ(failures(checks),
            (std::vector<std::string>{"records f32 = Algorithm 1", "arrays f32 = Algorithm 1"}));
}

TEST(Selftest, ADeviceThatFlushesSubnormalsIsFound) {
  PlainDevice::Spoiler spoiler;
  spoiler.f32 = [](std::size_t, Contact& contact) {
    if (std::fpclassify(contact.depth) == FP_SUBNORMAL) {
      contact.depth = 0;
    }
  };
  EXPECT_FALSE(failures(run_selftest(plan_for(std::make_shared<PlainDevice>(spoiler)))).empty());
}

// Claims a pair it never answered.
class SkippingDevice final : public PlainDevice {
 public:
  [[nodiscard]] Transaction submit(const Batch& batch) noexcept override {
    const auto* records = std::get_if<PairBatch<float>>(&batch);
    if (records == nullptr || records->pairs.empty()) {
      return PlainDevice::submit(batch);
    }
    const std::size_t n = records->pairs.size() - 1;
    return PlainDevice::submit(
        PairBatch<float>{records->pairs.first(n), records->contacts.first(n)});
  }
};

TEST(Selftest, ASkippedPairIsFound) {
  EXPECT_EQ(failures(run_selftest(plan_for(std::make_shared<SkippingDevice>()))),
            (std::vector<std::string>{"records f32 = Algorithm 1"}));
}

class FailingDevice final : public PlainDevice {
 public:
  [[nodiscard]] Transaction submit(const Batch&) noexcept override {
    return Transaction(Result<Outcome>(Error{Errc::device_fault, "Burnt out."}));
  }
};

TEST(Selftest, AnErrorIsAFailureWithItsMessage) {
  const auto checks = run_selftest(plan_for(std::make_shared<FailingDevice>()));
  EXPECT_EQ(failures(checks).size(), 9U);
  EXPECT_EQ(checks[0].first_mismatch, "Burnt out.");
}

TEST(Selftest, AModelledDeviceGetsFewPairs) {
  auto device = std::make_shared<PlainDevice>();
  device->capabilities_.modelled = true;
  SelftestPlan plan = plan_for(device);
  plan.modelled_pairs = 500;
  for (const SelftestCheck& check : run_selftest(plan)) {
    EXPECT_EQ(check.pairs, 500U);
    EXPECT_TRUE(check.passed()) << check.first_mismatch;
  }
}

TEST(Selftest, StopsWhenInterrupted) {
  int checks = 0;
  run_selftest(
      plan_for(std::make_shared<PlainDevice>()), [&](const SelftestCheck&) { ++checks; },
      [&] { return checks >= 2; });
  EXPECT_EQ(checks, 2);
}

TEST(Selftest, RecordedPairsCanBeChecked) {
  const NamedDevice device{"tested", 1, std::make_shared<PlainDevice>()};
  const SelftestCheck check = check_records(device, hard_pairs<float>(9, 1000, false));
  EXPECT_TRUE(check.passed());
  EXPECT_EQ(check.pairs, 1000U);
}

TEST(Selftest, TheCpuDeviceIsRightOnEveryInstructionSet) {
  SelftestPlan plan;
  for (const std::string& set : cpu_instruction_sets()) {
    CpuOptions options;
    options.instruction_set = set;
    Result<std::unique_ptr<Device>> device = make_cpu_device(options);
    ASSERT_TRUE(device) << set;
    plan.devices.push_back({set, 1, std::move(device.value())});
  }
  plan.pairs = 20000;
  const auto checks = run_selftest(plan);
  EXPECT_EQ(checks.size(), 6 * plan.devices.size());
  for (const SelftestCheck& check : checks) {
    EXPECT_TRUE(check.passed()) << check.device << " " << check.form << " " << check.against << ": "
                                << check.first_mismatch;
  }
}

}  // namespace
}  // namespace harpoon::bench
