#include "apps/result_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace harpoon::app {
namespace {

constexpr std::size_t kMostCounts = 10;

// All counts, or kMostCounts of them evenly spread with the last among them.
std::set<std::size_t> counts_to_show(const bench::ResultSet& results) {
  std::set<std::size_t> distinct;
  for (const bench::ResultRow& row : results.rows) {
    distinct.insert(row.measured.count);
  }
  const std::vector<std::size_t> all(distinct.begin(), distinct.end());
  const std::size_t stride = (all.size() + kMostCounts - 1) / kMostCounts;
  std::set<std::size_t> shown;
  for (std::size_t back = 0; back < all.size(); back += std::max<std::size_t>(stride, 1)) {
    shown.insert(all[all.size() - 1 - back]);
  }
  return shown;
}

std::string name_of(const bench::Label& label) {
  const bool is_usual = label.format == "records" || label.format == "geoms";
  return fmt::format("{} {}{}{}{}", label.device, label.precision, is_usual ? "" : " ",
                     is_usual ? "" : label.format, label.modelled ? " modelled" : "");
}

std::vector<Cell> row_cells(const bench::ResultRow& row) {
  const bench::Measurement& m = row.measured;
  const auto pairs = static_cast<double>(m.count);
  return {name_of(row.label),
          fmt::format("{}", row.label.threads),
          fmt::format("{}", m.count),
          fmt::format("{:.2f}", row.ns_per_pair()),
          fmt::format("{:.2f}", row.fastest_ns_per_pair()),
          fmt::format("{:.2f}-{:.2f}", m.ns.low / pairs, m.ns.high / pairs),
          fmt::format("{:.2f}", row.speedup_vs_ode),
          fmt::format("{:.1f}", row.gb_per_s())};
}

Cell verdict_cell(bench::TargetVerdict verdict) {
  switch (verdict) {
    case bench::TargetVerdict::pass:
      return {"pass", Colour::green};
    case bench::TargetVerdict::missed:
      return {"MISS", Colour::red};
    case bench::TargetVerdict::unsure:
      break;
  }
  return "too noisy to say";
}

}  // namespace

std::string describe_results(const Terminal& terminal, const bench::ResultSet& results) {
  const std::set<std::size_t> shown = counts_to_show(results);
  std::vector<bench::ResultRow> sorted = results.rows;
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return a.measured.count < b.measured.count;
  });
  std::vector<std::vector<Cell>> rows;
  for (const bench::ResultRow& row : sorted) {
    if (shown.contains(row.measured.count)) {
      rows.push_back(row_cells(row));
    }
  }
  std::string text = format_table(terminal,
                                  {{"device"},
                                   {"threads", true},
                                   {"pairs", true},
                                   {"ns/pair", true},
                                   {"fastest", true},
                                   {"10-90 %", true},
                                   {"x ODE", true},
                                   {"GB/s", true}},
                                  rows);
  for (const bench::CopyBandwidth& copy : results.copy) {
    text += fmt::format(
        "Copy bandwidth, {} thread(s): {:.1f} GB/s (memcpy {:.1f}, non-temporal {:.1f})\n",
        copy.threads, copy.best_gb_per_s(), copy.memcpy_gb_per_s, copy.non_temporal_gb_per_s);
  }
  text += paragraph(
      "ns/pair is the median over the rounds; x ODE and GB/s are those of the fastest batches, "
      "which "
      "other programs cannot move.");
  text +=
      paragraph(fmt::format("Reading the clock takes {:.1f} ns; it is taken out of ODE's times.",
                            results.timer_overhead_ns));
  text += paragraph(bench::describe_load(results.load));
  for (const std::string& note : results.notes) {
    text += paragraph(note);
  }
  return text;
}

#if HARPOON_WITH_ODE

std::string describe_targets(const Terminal& terminal, const std::vector<bench::Target>& targets) {
  std::vector<std::vector<Cell>> rows;
  for (const bench::Target& target : targets) {
    rows.push_back({target.what, fmt::format("{:.2f}", target.measured),
                    fmt::format("{:.2f}-{:.2f}", target.sure.low, target.sure.high),
                    fmt::format("{:.2f}", target.required), verdict_cell(target.verdict())});
  }
  std::string text = format_table(
      terminal,
      {{"target"}, {"measured", true}, {"surely in", true}, {"required", true}, {"verdict"}}, rows);
  text += "Each by itself:\n";
  for (const bench::Target& target : targets) {
    std::string continued;
    for (const std::string& line : broken_into_lines(target.command, kLineWidth - 6)) {
      text += fmt::format("{}{}", continued.empty() ? "  " : continued, line);
      continued = " \\\n    ";
    }
    text += "\n";
  }
  return text;
}

#endif

}  // namespace harpoon::app
