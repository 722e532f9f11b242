#include "apps/figures.hpp"

#include <fmt/format.h>

#include "bench/results.hpp"

namespace harpoon::app {
namespace {

std::vector<std::size_t> counts_by_step(std::size_t first, std::size_t last, std::size_t step) {
  std::vector<std::size_t> counts;
  for (std::size_t count = first; count <= last; count += step) {
    counts.push_back(count);
  }
  return counts;
}

bench::Json point_json(const bench::Measurement& m) {
  constexpr double kUsPerNs = 1e-3;
  return {{"count", m.count},
          {"total_us", m.ns.median * kUsPerNs},
          {"total_us_low", m.ns.low * kUsPerNs},
          {"total_us_high", m.ns.high * kUsPerNs}};
}

}  // namespace

std::vector<std::size_t> figure6_counts() {
  return counts_by_step(10, 1000, 10);
}
std::vector<std::size_t> figure7_counts() {
  return counts_by_step(1000, 90000, 1000);
}

std::string series_label(const bench::Label& label) {
  if (label.device == bench::kOdeDevice) {
    return "ODE, one batch";
  }
  if (label.device == bench::kOdeFigure5Device) {
    return "ODE, as Figure 5";
  }
  return fmt::format("{} {}, {} thread{}{}", label.device, label.precision, label.threads,
                     label.threads == 1 ? "" : "s", label.modelled ? " (modelled)" : "");
}

bench::Json figure_json(const std::string& id, const std::string& title,
                        const std::vector<bench::Series>& series) {
  bench::Json all = bench::Json::array();
  for (const bench::Series& s : series) {
    bench::Json points = bench::Json::array();
    for (const bench::Measurement& m : s.points) {
      points.push_back(point_json(m));
    }
    all.push_back({{"label", series_label(s.label)},
                   {"device", s.label.device},
                   {"precision", s.label.precision},
                   {"modelled", s.label.modelled},
                   {"points", points}});
  }
  const bench::Json references = {
      {{"label", fmt::format("paper, ODE: {} ns", kPaperOdeNs)}, {"ns_per_pair", kPaperOdeNs}},
      {{"label", fmt::format("paper, AFU: {} ns", kPaperAfuNs)}, {"ns_per_pair", kPaperAfuNs}}};
  return {{"id", id}, {"title", title}, {"series", all}, {"references", references}};
}

std::string figure_csv(const std::vector<bench::Series>& series) {
  std::string csv =
      "label,device,precision,threads,modelled,count,total_us,total_us_low,total_us_high\n";
  for (const bench::Series& s : series) {
    for (const bench::Measurement& m : s.points) {
      csv += fmt::format("\"{}\",{},{},{},{},{},{:.6g},{:.6g},{:.6g}\n", series_label(s.label),
                         s.label.device, s.label.precision, s.label.threads, s.label.modelled,
                         m.count, m.ns.median * 1e-3, m.ns.low * 1e-3, m.ns.high * 1e-3);
    }
  }
  return csv;
}

}  // namespace harpoon::app
