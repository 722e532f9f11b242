#include "apps/report.hpp"

#include <fmt/format.h>

#include "apps/exit_code.hpp"
#include "apps/figures.hpp"
#include "apps/report_headlines.hpp"
#include "bench/lattice.hpp"

namespace harpoon::app {
namespace {

constexpr std::string_view kSlot =
    R"(<script type="application/json" id="harpoon-data">null</script>)";
constexpr std::string_view kNull = "null";

bench::Json diamonds_json() {
  const bench::DiamondParameters defaults;
  bench::Json diamonds = bench::Json::array();
  for (const unsigned h_max : {2U, 10U, 30U}) {
    diamonds.push_back({{"hmax", h_max},
                        {"dsph", 0},
                        {"radius", defaults.radius},
                        {"spheres", bench::diamond_sphere_count(h_max)}});
  }
  return diamonds;
}

bench::Json headlines_json(const Experiment& experiment, const bench::ResultSet& results) {
  bench::Json all = bench::Json::array();
  for (const Headline& one : headlines(experiment, results)) {
    all.push_back({{"value", one.value},
                   {"label", one.label},
                   {"detail", one.detail},
                   {"modelled", one.modelled}});
  }
  return all;
}

bench::Json claims_json(const Experiment& experiment) {
  bench::Json claims = bench::Json::array();
  for (const Claim& claim : judge_claims(experiment)) {
    claims.push_back({{"paper", claim.paper}, {"ours", claim.ours}, {"verdict", claim.verdict}});
  }
  return claims;
}

}  // namespace

bench::Json report_data(const Experiment& experiment, const bench::ResultSet& results) {
  bench::Json rows = bench::Json::array();
  for (const bench::ResultRow& row : results.rows) {
    rows.push_back(bench::row_json(row));
  }
  return {
      {"schema", 2},
      {"title", "Harpoon: the paper's experiment"},
      {"experiment",
       "Real collisions of spheres, recorded from a diamond of 63 spheres (hMax 3, dSph 0) that "
       "ODE pulls to its centre, are executed by stock ODE and by every device of this machine, "
       "in turns."},
      {"headlines", headlines_json(experiment, results)},
      {"machine", bench::machine_json(results.machine)},
      {"load", bench::load_json(results.load)},
      {"load_text", bench::describe_load(results.load)},
      {"commit", results.commit},
      {"date", results.date},
      {"command", results.command},
      {"timer_overhead_ns", results.timer_overhead_ns},
      {"results", rows},
      {"figures",
       {figure_json("6", "Real collisions, 10 to 1000", experiment.figure6.series),
        figure_json("7", "Real collisions, 1000 to 90000", experiment.figure7.series)}},
      {"diamonds", diamonds_json()},
      {"claims", claims_json(experiment)},
      {"notes", results.notes}};
}

std::string fill_template(std::string_view page, const bench::Json& data) {
  const std::size_t slot = page.find(kSlot);
  if (slot == std::string_view::npos) {
    throw CommandError(ExitCode::failure,
                       "The report's page has no place for data. Rebuild it from web/.");
  }
  const std::size_t null_at = slot + kSlot.find(kNull);
  std::string filled(page.substr(0, null_at));
  for (const char c : data.dump()) {
    if (c == '<') {
      filled += "\\u003c";
    } else {
      filled += c;
    }
  }
  return filled.append(page.substr(null_at + kNull.size()));
}

}  // namespace harpoon::app
