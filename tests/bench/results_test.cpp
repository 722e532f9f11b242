#include "bench/results.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "bench/json.hpp"

namespace harpoon::bench {
namespace {

Measurement measurement(std::size_t count, double ns) {
  return {count, {ns, ns * 0.9, ns * 0.95, ns * 1.2, 5, ns}, 50};
}

ResultSet example() {
  const std::vector<Series> series = {
      {{kOdeDevice, "f64", 1, "geoms", false, 128}, {measurement(10, 100), measurement(20, 220)}},
      {{"cpu", "f32", 2, "records", false, 64}, {measurement(10, 20), measurement(20, 22)}}};
  const std::vector<Series> copies = {
      {{"copy", "bytes", 1, "memcpy", false, 64}, {measurement(10, 100)}},
      {{"copy", "bytes", 1, "non-temporal", false, 64}, {measurement(10, 80)}}};
  ResultSet results;
  results.machine = describe_machine();
  results.machine.cpu = "A \"fast\" CPU, 3 GHz";
  results.commit = "0123456789ab";
  results.date = "2026-01-02T03:04:05Z";
  results.command = "harpoon bench pairs";
  results.timer_overhead_ns = 25;
  results.rows = to_rows(series, PairType::real);
  results.copy = to_copy_bandwidths(copies);
  results.notes = {"a note"};
  return results;
}

TEST(Results, SpeedUpRelatesToOdeAtTheSameCount) {
  const ResultSet results = example();
  ASSERT_EQ(results.rows.size(), 4U);
  EXPECT_EQ(results.rows[0].speedup_vs_ode, 1);
  EXPECT_EQ(results.rows[2].speedup_vs_ode, 5);
  EXPECT_EQ(results.rows[3].speedup_vs_ode, 10);
  EXPECT_DOUBLE_EQ(results.rows[2].gb_per_s(), 32 / 0.9);
  EXPECT_DOUBLE_EQ(results.rows[3].megabytes(), 20 * 64e-6);
  EXPECT_DOUBLE_EQ(results.rows[2].speedup_range.low, 4.5);
  EXPECT_DOUBLE_EQ(results.rows[2].speedup_range.high, 5 / 0.9);
}

TEST(Results, SlowRunsMoveNoSpeedUp) {
  std::vector<Series> series = {
      {{kOdeDevice, "f64", 1, "geoms", false, 128}, {measurement(10, 100)}},
      {{"cpu", "f32", 1, "records", false, 64}, {measurement(10, 20)}}};
  series[1].points[0].ns.median = 5000;
  series[1].points[0].ns.high = 90000;
  EXPECT_EQ(to_rows(series, PairType::real)[1].speedup_vs_ode, 5);
}

TEST(Results, WithoutOdeThereIsNoSpeedUp) {
  const std::vector<Series> series = {
      {{"cpu", "f32", 1, "records", false, 64}, {measurement(10, 20)}}};
  EXPECT_EQ(to_rows(series, PairType::real)[0].speedup_vs_ode, 0);
}

TEST(Results, TheBestCopyIsTheMachinesBandwidth) {
  const ResultSet results = example();
  ASSERT_EQ(results.copy.size(), 1U);
  EXPECT_DOUBLE_EQ(results.copy[0].memcpy_gb_per_s, 6.4 / 0.9);
  EXPECT_DOUBLE_EQ(results.copy[0].best_gb_per_s(), 8 / 0.9);
  EXPECT_DOUBLE_EQ(results.copy[0].best_range.low, 8);
  EXPECT_DOUBLE_EQ(results.copy[0].best_range.high, 8 / 0.9);
}

TEST(Results, JsonHasThePromisedFieldsWithThePromisedTypes) {
  const Json root = Json::parse(to_json(example()));
  EXPECT_TRUE(root.at("machine").is_object());
  EXPECT_TRUE(root.at("commit").is_string());
  ASSERT_TRUE(root.at("results").is_array());
  ASSERT_EQ(root.at("results").size(), 4U);
  for (const Json& row : root.at("results")) {
    for (const char* field : {"device", "precision", "type"}) {
      EXPECT_TRUE(row.at(field).is_string()) << field;
    }
    for (const char* field : {"threads", "count", "runs"}) {
      EXPECT_TRUE(row.at(field).is_number_unsigned()) << field;
    }
    for (const char* field : {"ns_per_pair", "ns_per_pair_min", "speedup_vs_ode", "speedup_low",
                              "speedup_high", "gb_per_s", "megabytes"}) {
      EXPECT_TRUE(row.at(field).is_number()) << field;
    }
    EXPECT_TRUE(row.at("modelled").is_boolean());
  }
  EXPECT_EQ(root.at("results")[0].at("device"), "ode");
  EXPECT_EQ(root.at("results")[2].at("ns_per_pair"), 2);
  for (const char* field : {"cpu", "os", "kernel", "compiler", "instruction_set", "ode"}) {
    EXPECT_TRUE(root.at("machine").at(field).is_string()) << field;
  }
  EXPECT_NEAR(root.at("copy_bandwidth")[0].at("best_gb_per_s").get<double>(), 8 / 0.9, 1e-9);
  for (const char* field : {"before", "after", "waiting", "busy"}) {
    EXPECT_TRUE(root.at("load").contains(field)) << field;
  }
}

TEST(Results, CsvHasOneCellPerColumn) {
  const std::string csv = to_csv(example());
  const std::string header = csv_header();
  const auto columns = static_cast<std::size_t>(std::count(header.begin(), header.end(), ',')) + 1;
  const std::string line = csv.substr(0, csv.find('\n'));
  std::size_t cells = 1;
  bool in_quotes = false;
  for (const char c : line) {
    in_quotes = c == '"' ? !in_quotes : in_quotes;
    cells += c == ',' && !in_quotes ? 1U : 0U;
  }
  EXPECT_EQ(cells, columns);
  EXPECT_NE(line.find("\"A \"\"fast\"\" CPU, 3 GHz\""), std::string::npos);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
}

TEST(Machine, IsDescribed) {
  const Machine machine = describe_machine();
  EXPECT_FALSE(machine.cpu.empty());
  EXPECT_GE(machine.cores, 1U);
  EXPECT_GT(machine.memory_gb, 0.1);
  EXPECT_GE(machine.cache_mb, 0);
  EXPECT_NE(machine.kernel, "unknown");
  EXPECT_FALSE(machine.instruction_set.empty());
  EXPECT_FALSE(build_commit().empty());
  ASSERT_EQ(timestamp().size(), 20U);
  EXPECT_EQ(timestamp()[10], 'T');
  EXPECT_EQ(timestamp().back(), 'Z');
}

}  // namespace
}  // namespace harpoon::bench
