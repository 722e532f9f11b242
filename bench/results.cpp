#include "bench/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/json.hpp"

namespace harpoon::bench {
namespace {

// A bandwidth in GB/s is a number of bytes per nanosecond.
double bytes_per_ns(const Label& label, const Measurement& m) {
  return label.bytes_per_pair / m.fastest_ns_per_pair();
}

// Commas and quotes occur in CPU names.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    out += c;
    if (c == '"') {
      out += c;
    }
  }
  return out + "\"";
}

}  // namespace

double ResultRow::gb_per_s() const {
  return bytes_per_ns(label, measured);
}

double ResultRow::megabytes() const {
  return label.bytes_per_pair * static_cast<double>(measured.count) * 1e-6;
}

double CopyBandwidth::best_gb_per_s() const {
  return std::max(memcpy_gb_per_s, non_temporal_gb_per_s);
}

std::vector<ResultRow> to_rows(std::span<const Series> series, PairType type) {
  std::map<std::size_t, Summary> ode_ns;
  for (const Series& s : series) {
    if (s.label.device == kOdeDevice) {
      for (const Measurement& m : s.points) {
        ode_ns[m.count] = m.ns;
      }
    }
  }
  std::vector<ResultRow> rows;
  for (const Series& s : series) {
    for (const Measurement& m : s.points) {
      const auto ode = ode_ns.find(m.count);
      ResultRow row{s.label, type, m, 0, {}};
      if (ode != ode_ns.end()) {
        row.speedup_vs_ode = ode->second.min / m.ns.min;
        row.speedup_range = ratio_of(ode->second.undisturbed(), m.ns.undisturbed());
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::vector<CopyBandwidth> to_copy_bandwidths(std::span<const Series> series) {
  std::map<unsigned, CopyBandwidth> by_threads;
  for (const Series& s : series) {
    CopyBandwidth& copy = by_threads[s.label.threads];
    copy.threads = s.label.threads;
    const Measurement& m = s.points.back();
    const double rate = bytes_per_ns(s.label, m);
    if (rate > copy.best_gb_per_s()) {
      copy.best_range = {rate / (1 + m.ns.undisturbed().width()), rate};
    }
    (s.label.format == "memcpy" ? copy.memcpy_gb_per_s : copy.non_temporal_gb_per_s) = rate;
  }
  std::vector<CopyBandwidth> all;
  for (const auto& [threads, copy] : by_threads) {
    all.push_back(copy);
  }
  return all;
}

std::string to_json(const ResultSet& results) {
  Json rows = Json::array();
  for (const ResultRow& row : results.rows) {
    rows.push_back(row_json(row));
  }
  Json copies = Json::array();
  for (const CopyBandwidth& copy : results.copy) {
    copies.push_back({{"threads", copy.threads},
                      {"memcpy_gb_per_s", copy.memcpy_gb_per_s},
                      {"non_temporal_gb_per_s", copy.non_temporal_gb_per_s},
                      {"best_gb_per_s", copy.best_gb_per_s()}});
  }
  Json root = head_json(results.machine, results.commit, results.date, results.command);
  root["load"] = load_json(results.load);
  root["timer_overhead_ns"] = results.timer_overhead_ns;
  root["results"] = std::move(rows);
  root["copy_bandwidth"] = std::move(copies);
  root["notes"] = results.notes;
  return root.dump(2) + "\n";
}

std::string csv_header() {
  return "date,commit,cpu,compiler,device,precision,threads,format,count,type,ns_per_pair,"
         "ns_per_pair_min,ns_per_pair_low,ns_per_pair_high,modelled,speedup_vs_ode,gb_per_s,runs";
}

std::string to_csv(const ResultSet& results) {
  std::string text;
  for (const ResultRow& row : results.rows) {
    const Label& label = row.label;
    const Measurement& m = row.measured;
    const auto pairs = static_cast<double>(m.count);
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{},{:.6g},"
        "{:.6g},{}\n",
        results.date, results.commit, quoted(results.machine.cpu), quoted(results.machine.compiler),
        label.device, label.precision, label.threads, label.format, m.count, to_string(row.type),
        row.ns_per_pair(), m.ns.min / pairs, m.ns.low / pairs, m.ns.high / pairs, label.modelled,
        row.speedup_vs_ode, row.gb_per_s(), m.runs);
  }
  return text;
}

}  // namespace harpoon::bench
