#pragma once

// The rows of a result table, and their JSON and CSV. The same nouns in all of them.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/machine.hpp"
#include "bench/machine_load.hpp"
#include "bench/pair_type.hpp"
#include "bench/round_robin.hpp"

namespace harpoon::bench {

/// The device name of ODE's batch on the same pairs, to which all speed-ups relate, and of the
/// paper's way to time it.
inline constexpr const char* kOdeDevice = "ode";
inline constexpr const char* kOdeFigure5Device = "ode (Figure 5)";

struct ResultRow {
  Label label;
  PairType type = PairType::real;
  Measurement measured;
  /// ODE's fastest batch over this one's in the same run, which nothing else on the machine moves;
  /// 0 when ODE did not run.
  double speedup_vs_ode = 0;
  Range speedup_range;  ///< how sure that is: see Summary::undisturbed

  [[nodiscard]] double ns_per_pair() const { return measured.ns_per_pair(); }
  [[nodiscard]] double fastest_ns_per_pair() const { return measured.fastest_ns_per_pair(); }
  /// Of the fastest batch.
  [[nodiscard]] double gb_per_s() const;
  /// What its records occupy, in and out.
  [[nodiscard]] double megabytes() const;
};

/// One row per series and count, in order of the series. Speed-ups relate to the series whose
/// device is kOdeDevice at the same count.
std::vector<ResultRow> to_rows(std::span<const Series> series, PairType type);

/// Bandwidth of copying, from the fastest copies of the copy contestants.
struct CopyBandwidth {
  unsigned threads = 1;
  double memcpy_gb_per_s = 0;
  double non_temporal_gb_per_s = 0;
  Range best_range;  ///< how sure the better of them is, as a bandwidth

  /// The machine's copy bandwidth.
  [[nodiscard]] double best_gb_per_s() const;
};
std::vector<CopyBandwidth> to_copy_bandwidths(std::span<const Series> series);

/// Everything that `bench pairs` says.
struct ResultSet {
  Machine machine;
  std::string commit;
  std::string date;
  std::string command;
  double timer_overhead_ns = 0;
  std::vector<ResultRow> rows;
  std::vector<CopyBandwidth> copy;
  std::vector<std::string> notes;
  MachineLoad load;
};

/// The JSON object documented in docs/experiment.md, indented, with a final newline.
std::string to_json(const ResultSet& results);

/// The first line of the CSV, without newline.
std::string csv_header();
/// One line per row, each with newline.
std::string to_csv(const ResultSet& results);

}  // namespace harpoon::bench
