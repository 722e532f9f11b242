// Figures, claims and the page, from an experiment with known numbers.

#include "apps/report.hpp"

#include <gtest/gtest.h>

#include "apps/exit_code.hpp"
#include "apps/figures.hpp"

namespace harpoon::app {
namespace {

using bench::Json;

bench::Series series(const char* device, const char* precision, double fixed_ns, double ns_per_pair,
                     const std::vector<std::size_t>& counts) {
  bench::Series s{{device, precision, 1, "records", false, 64}, {}};
  for (const std::size_t count : counts) {
    const double ns = fixed_ns + ns_per_pair * static_cast<double>(count);
    s.points.push_back({count, {ns, ns, ns * 0.9, ns * 1.1, 5}, 50});
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

TEST(Claims, BreakEvenIsWhereTheDeviceStaysAhead) {
  const bench::Series ode = series("ode", "f64", 0, 10, {10, 20, 30, 40});
  EXPECT_EQ(break_even(series("cpu", "f32", 0, 1, {10, 20, 30, 40}), ode), 10U);
  EXPECT_EQ(break_even(series("cpu", "f32", 250, 1, {10, 20, 30, 40}), ode), 30U);
  EXPECT_FALSE(break_even(series("cpu", "f32", 0, 11, {10, 20, 30, 40}), ode));
  EXPECT_EQ(break_even(series("afu", "f32", 150, 1, {10, 30, 40}), ode), 30U);
  EXPECT_FALSE(break_even(series("afu", "f32", 0, 1, {11, 12}), ode));
}

TEST(Claims, VerdictsFollowFromTheNumbers) {
  const std::vector<Claim> claims = judge_claims(example());
  ASSERT_EQ(claims.size(), 6U);
  EXPECT_EQ(claims[0].verdict, "holds");  // a straight line
  EXPECT_EQ(claims[1].verdict, "10.2 times less on this machine");
  EXPECT_EQ(claims[3].verdict, "exceeded");
  EXPECT_EQ(claims[4].verdict, "holds");
  EXPECT_NE(claims[4].ours.find("from 50 collisions"), std::string::npos) << claims[4].ours;
  EXPECT_EQ(claims[5].verdict, "holds");
  EXPECT_NE(claims[5].ours.find("0 of 1000"), std::string::npos);
}

TEST(Claims, NameOurAfuAndThatItIsModelled) {
  Experiment experiment = example();
  EXPECT_EQ(judge_claims(experiment)[2].ours.find("Our AFU"), std::string::npos);
  bench::Series afu = series("afu", "f32", 0, 8, {1000, 90000});
  afu.label.modelled = true;
  experiment.figure7.series.push_back(afu);
  EXPECT_NE(judge_claims(experiment)[2].ours.find("Our AFU takes 8.0 ns (modelled)."),
            std::string::npos);
}

TEST(Claims, StateTheBreakEvenOfOurAfuAsFound) {
  Experiment experiment = example();
  EXPECT_EQ(judge_claims(experiment)[4].ours.find("Our AFU"), std::string::npos);
  // ODE takes 9 ns as in Figure 5, 10 ns as one batch.
  bench::Series afu = series("afu", "f32", 1600, 8, {10, 110, 510, 900, 1000});
  afu.label.modelled = true;
  experiment.figure6.series.push_back(afu);
  experiment.figure7.series.push_back(series("afu", "f32", 1600, 8, {1000, 2000, 12000, 90000}));
  const std::string ours = judge_claims(experiment)[4].ours;
  EXPECT_NE(ours.find("Our AFU (modelled) is ahead of ODE as timed in Figure 5 from 2000 "
                      "collisions on, and ahead of ODE as one batch from 900 collisions on."),
            std::string::npos)
      << ours;
  experiment.figure7.series.back() = series("afu", "f32", 0, 9.5, {1000, 90000});
  EXPECT_NE(judge_claims(experiment)[4].ours.find("not ahead of ODE as timed in Figure 5 at 90000"),
            std::string::npos);
}

TEST(Claims, AreNotWonByDefault) {
  Experiment slow = example();
  for (bench::PairsOutcome* figure : {&slow.figure6, &slow.figure7}) {
    for (bench::Measurement& m : figure->series[2].points) {
      m.ns.median = 20 * static_cast<double>(m.count);
      if (m.count % 2000 == 0) {
        m.ns.median *= 10;
      }
    }
    figure->census = {10, 5, 5};
  }
  const std::vector<Claim> claims = judge_claims(slow);
  EXPECT_EQ(claims[0].verdict, "does not hold here");
  EXPECT_EQ(claims[3].verdict, "not reached here");
  EXPECT_EQ(claims[4].verdict, "not reached here");
  EXPECT_EQ(claims[5].verdict, "does not hold here");
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
  EXPECT_NE(all.find("All 90000 contacts"), std::string::npos);
  EXPECT_TRUE(experiment.contacts_are_right());
  experiment.checks[0].mismatches = 1;
  EXPECT_FALSE(experiment.contacts_are_right());
  EXPECT_NE(report_notes(experiment).back().find("DIFFER"), std::string::npos);
}

TEST(Report, DataHasEveryFieldOfTheSchema) {
  const Experiment experiment = example();
  const Json data = report_data(experiment, results_of(experiment));
  EXPECT_EQ(data.at("schema"), 1);
  for (const char* field : {"title", "experiment", "commit", "date", "command"}) {
    EXPECT_TRUE(data.at(field).is_string()) << field;
  }
  for (const char* field : {"cpu", "cores", "memory_gb", "os", "kernel", "compiler",
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
