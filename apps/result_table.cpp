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

std::vector<Cell> row_cells(const bench::ResultRow& row) {
  const bench::Measurement& m = row.measured;
  const auto pairs = static_cast<double>(m.count);
  return {row.label.device,
          row.label.precision,
          fmt::format("{}", row.label.threads),
          row.label.format,
          fmt::format("{}", m.count),
          fmt::format("{:.2f}", row.ns_per_pair()),
          fmt::format("{:.2f}", m.ns.min / pairs),
          fmt::format("{:.2f}-{:.2f}", m.ns.low / pairs, m.ns.high / pairs),
          fmt::format("{:.2f}", row.speedup_vs_ode),
          fmt::format("{:.1f}", row.gb_per_s()),
          row.label.modelled ? "modelled" : "measured"};
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
                                   {"precision"},
                                   {"threads", true},
                                   {"format"},
                                   {"pairs", true},
                                   {"ns/pair", true},
                                   {"min", true},
                                   {"10-90 %", true},
                                   {"x ODE", true},
                                   {"GB/s", true},
                                   {"time"}},
                                  rows);
  for (const bench::CopyBandwidth& copy : results.copy) {
    text += fmt::format(
        "Copy bandwidth, {} thread(s): {:.1f} GB/s (memcpy {:.1f}, non-temporal {:.1f})\n",
        copy.threads, copy.best_gb_per_s(), copy.memcpy_gb_per_s, copy.non_temporal_gb_per_s);
  }
  text += fmt::format("Reading the clock takes {:.1f} ns; it is taken out of ODE's times.\n",
                      results.timer_overhead_ns);
  for (const std::string& note : results.notes) {
    text += note + "\n";
  }
  return text;
}

}  // namespace harpoon::app
