// Figures, claims and the page, from an experiment with known numbers.

#include "apps/report.hpp"

#include <gtest/gtest.h>

#include "apps/exit_code.hpp"
#include "apps/figures.hpp"
#include "apps/report_headlines.hpp"

namespace harpoon::app {
namespace {

using bench::Json;

bench::Series series(const char* device, const char* precision, double fixed_ns, double ns_per_pair,
                     const std::vector<std::size_t>& counts) {
  bench::Series s{{device, precision, 1, "records", false, 64}, {}};
  for (const std::size_t count : counts) {
    const double ns = fixed_ns + ns_per_pair * static_cast<double>(count);
    s.points.push_back({count, {ns, ns, ns * 0.9, ns * 1.1, 5, ns}, 50});
  }
  return s;
}

// cpu f32 has a set-up of 450 ns and takes 1 ns a pair, ODE 10 ns: they meet at 50 pairs.
Experiment example() {
  const auto outcome = [](const std::vector<std::size_t>& counts) {
    bench::PairsOutcome o;
    o.series = {series(bench::kOdeDevice, "f64", 0, 10, counts),
                series(bench::kOdeFigure5Device, "f64", 0, 9, counts),
                series("cpu", "f32", 450, 1, counts), series("cpu", "f64", 450, 2, counts)};
    o.census = {600, 0, 400};
    return o;
  };
  Experiment experiment;
  experiment.figure6 = outcome(figure6_counts());
  experiment.figure7 = outcome(figure7_counts());
  experiment.table = outcome({10, 1000});
  experiment.checks = {{"cpu", "records", "f32 = Algorithm 1", 90000, 0, ""}};
  return experiment;
}

bench::ResultSet results_of(const Experiment& experiment) {
  bench::ResultSet results;
  results.machine = bench::describe_machine();
  results.commit = "abc";
  results.command = "harpoon demo --out </script><b>";
  results.date = bench::timestamp();
  results.rows = bench::to_rows(experiment.table.series, bench::PairType::real);
  results.notes = report_notes(experiment);
  return results;
}

TEST(Figures, HaveThePapersCounts) {
  EXPECT_EQ(figure6_counts().size(), 100U);
  EXPECT_EQ(figure6_counts().front(), 10U);
  EXPECT_EQ(figure6_counts().back(), 1000U);
  EXPECT_EQ(figure7_counts().size(), 90U);
  EXPECT_EQ(figure7_counts().back(), 90000U);
}

TEST(Figures, JsonHasSeriesInMicrosecondsAndThePapersReferences) {
  const Json figure = figure_json("7", "title", example().figure7.series);
  EXPECT_EQ(figure.at("id"), "7");
  ASSERT_EQ(figure.at("series").size(), 4U);
  const Json& ode = figure.at("series")[0];
  EXPECT_EQ(ode.at("label"), "ODE, one batch");
  EXPECT_EQ(ode.at("modelled"), false);
  EXPECT_EQ(ode.at("points")[0].at("count"), 1000);
  EXPECT_DOUBLE_EQ(ode.at("points")[0].at("total_us"), 10);
  EXPECT_DOUBLE_EQ(ode.at("points")[0].at("total_us_low"), 9);
  EXPECT_DOUBLE_EQ(ode.at("points")[0].at("total_us_high"), 11);
  EXPECT_EQ(figure.at("series")[2].at("label"), "cpu f32, 1 thread");
  EXPECT_EQ(figure.at("references")[0].at("label"), "paper, ODE: 102 ns");
  EXPECT_EQ(figure.at("references")[0].at("ns_per_pair"), 102);
  EXPECT_EQ(figure.at("references")[1].at("label"), "paper, AFU: 86 ns");
}

TEST(Figures, LabelsTellModelledFromMeasured) {
  EXPECT_EQ(series_label({"afu", "f32", 1, "records", true, 64}), "afu f32, 1 thread (modelled)");
  EXPECT_EQ(series_label({"cpu", "f64", 2, "records", false, 64}), "cpu f64, 2 threads");
}

TEST(Figures, CsvHasALinePerPoint) {
  const std::string csv = figure_csv(example().figure6.series);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 4 * 100);
  EXPECT_NE(csv.find("\"cpu f32, 1 thread\",cpu,f32,1,false,10,0.46,"), std::string::npos);
}

TEST(Report, NotesStateTheMisprintsAndTheComparison) {
  Experiment experiment = example();
  std::string all;
  for (const std::string& note : report_notes(experiment)) {
    all += note + "\n";
  }
  EXPECT_NE(all.find("2000 milliseconds"), std::string::npos);
  EXPECT_NE(all.find("nanoseconds"), std::string::npos);
  EXPECT_NE(all.find("15.7 %"), std::string::npos);
  // Why two places of the page may differ.
  EXPECT_NE(all.find("not quotients of the medians"), std::string::npos);
  EXPECT_NE(all.find("three measurements, one after the other"), std::string::npos);
  EXPECT_NE(all.find("All 90000 contacts"), std::string::npos);
  EXPECT_TRUE(experiment.contacts_are_right());
  experiment.checks[0].mismatches = 1;
  EXPECT_FALSE(experiment.contacts_are_right());
  EXPECT_NE(report_notes(experiment).back().find("DIFFER"), std::string::npos);
}

TEST(Report, DataHasEveryFieldOfTheSchema) {
  const Experiment experiment = example();
  const Json data = report_data(experiment, results_of(experiment));
  EXPECT_EQ(data.at("schema"), 2);
  EXPECT_TRUE(data.at("load_text").is_string());
  EXPECT_TRUE(data.at("load").is_object());
  ASSERT_FALSE(data.at("headlines").empty());
  for (const char* field : {"value", "label", "detail"}) {
    EXPECT_TRUE(data.at("headlines")[0].at(field).is_string()) << field;
  }
  for (const char* field : {"title", "experiment", "commit", "date", "command"}) {
    EXPECT_TRUE(data.at(field).is_string()) << field;
  }
  for (const char* field : {"cpu", "cores", "memory_gb", "cache_mb", "os", "kernel", "compiler",
                            "instruction_set", "ode", "harpoon"}) {
    EXPECT_TRUE(data.at("machine").contains(field)) << field;
  }
  for (const char* field : {"device", "precision", "threads", "count", "type", "ns_per_pair",
                            "ns_per_pair_min", "modelled", "speedup_vs_ode", "gb_per_s", "runs"}) {
    EXPECT_TRUE(data.at("results")[0].contains(field)) << field;
  }
  ASSERT_EQ(data.at("figures").size(), 2U);
  EXPECT_EQ(data.at("figures")[0].at("id"), "6");
  const Json expected = Json::parse(R"([
      {"hmax": 2, "dsph": 0, "radius": 0.1, "spheres": 25},
      {"hmax": 10, "dsph": 0, "radius": 0.1, "spheres": 1561},
      {"hmax": 30, "dsph": 0, "radius": 0.1, "spheres": 37881}])");
  EXPECT_EQ(data.at("diamonds"), expected);
  EXPECT_EQ(data.at("claims").size(), 6U);
  EXPECT_TRUE(data.at("notes").is_array());
  EXPECT_TRUE(data.at("timer_overhead_ns").is_number());
}

TEST(Headlines, AreThoseOfTheResultsAndTheClaims) {
  const Experiment experiment = example();
  bench::ResultSet results = results_of(experiment);
  results.machine.cache_mb = 1;
  const std::vector<Headline> all = headlines(experiment, results);
  ASSERT_EQ(all.size(), 3U);         // nothing on several threads, nothing modelled
  EXPECT_EQ(all[0].value, "6.90×");  // 10000 ns against 450 + 1000
  EXPECT_NE(all[0].detail.find("cpu f32, 1000 real collisions: 1.45 ns against ODE's 10.0 ns"),
            std::string::npos)
      << all[0].detail;
  EXPECT_EQ(all[1].value, "50");
  EXPECT_NE(judge_claims(experiment)[4].ours.find("from 50 collisions"), std::string::npos);
  EXPECT_EQ(all[2].value, "44.1 GB/s");
}

TEST(Headlines, SayWhatFitsInTheCacheAndWhatComesFromMemory) {
  const Experiment experiment = example();
  bench::ResultSet results = results_of(experiment);
  results.machine.cache_mb = 1;
  EXPECT_NE(headlines(experiment, results)[0].detail.find(
                "These 0.06 MB fit in the cache of 1.00 MB; nothing larger was measured"),
            std::string::npos);
  results.machine.cache_mb = 0.01;  // holds the batch of 10, not that of 1000
  EXPECT_EQ(headlines(experiment, results)[0].detail.find("cache"), std::string::npos);
  for (bench::ResultRow& row : results.rows) {
    if (row.measured.count == 10) {
      row.speedup_vs_ode = 20;
      row.speedup_range = {20, 20};
    }
  }
  const std::string detail = headlines(experiment, results)[0].detail;
  EXPECT_NE(detail.find("from memory (1000 collisions, 0.06 MB): 6.90×"), std::string::npos)
      << detail;
}

TEST(Headlines, GiveARangeWhereANumberIsNotSure) {
  const Experiment experiment = example();
  bench::ResultSet results = results_of(experiment);
  for (bench::ResultRow& row : results.rows) {
    row.speedup_range = {row.speedup_vs_ode * 0.7, row.speedup_vs_ode * 1.2};
  }
  EXPECT_EQ(headlines(experiment, results)[0].value, "4.83 to 8.28×");
}

TEST(Report, DataCannotEndTheElementAndComesBackWhole) {
  const Experiment experiment = example();
  const Json data = report_data(experiment, results_of(experiment));
  const std::string before =
      "<!doctype html><script type=\"application/json\" "
      "id=\"harpoon-data\">";
  const std::string after = "</script><p>null</p>";
  const std::string page = fill_template(before + "null" + after, data);
  ASSERT_EQ(page.substr(0, before.size()), before);
  ASSERT_EQ(page.substr(page.size() - after.size()), after);
  const std::string inside = page.substr(before.size(), page.size() - before.size() - after.size());
  EXPECT_EQ(inside.find('<'), std::string::npos);
  EXPECT_EQ(Json::parse(inside), data);
}

TEST(Report, APageWithoutASlotIsRefused) {
  EXPECT_THROW(fill_template("<html></html>", Json{}), CommandError);
}

TEST(Report, TheEmbeddedPageHasASlotAndNothingBehindIt) {
  const std::string_view page = report_template();
  EXPECT_EQ(page.find('\0'), std::string_view::npos);
  EXPECT_NE(page.find("</html>"), std::string_view::npos);
  EXPECT_NE(fill_template(page, Json{{"schema", 1}}).find("{\"schema\":1}"), std::string::npos);
}

}  // namespace
}  // namespace harpoon::app
