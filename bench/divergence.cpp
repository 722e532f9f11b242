#include "bench/divergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "bench/chart.hpp"
#include "bench/stats.hpp"

namespace harpoon::bench {
namespace {

/// An axis for a plot in which nothing parts.
constexpr double kLowest = 1e-12, kHighest = 1;

struct Place {
  unsigned step = 0;
  std::size_t sphere = 0;
  Point position{};
};

template <class Number>
bool take(std::string_view& text, Number& number, char end) {
  const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const auto length = static_cast<std::size_t>(next - text.data());
  if (error != std::errc() || length >= text.size() || text[length] != end) return false;
  text.remove_prefix(length + 1);
  return true;
}

/// Takes the next line of a file of positions.
std::optional<Place> take_place(std::string_view& text) {
  Place place;
  const bool good = take(text, place.step, ',') && take(text, place.sphere, ',') &&
                    take(text, place.position[0], ',') && take(text, place.position[1], ',') &&
                    take(text, place.position[2], '\n');
  return good ? std::optional(place) : std::nullopt;
}

bool take_header(std::string_view& text) {
  if (!text.starts_with(kPositionsHeader)) return false;
  text.remove_prefix(kPositionsHeader.size());
  if (!text.starts_with('\n')) return false;
  text.remove_prefix(1);
  return true;
}

double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

Divergence summarize_step(unsigned step, const std::vector<double>& distances) {
  return {step, quantile_of(distances, 0.5), *std::max_element(distances.begin(), distances.end())};
}

Error bad_line(std::size_t line, const char* what) {
  return {Errc::invalid_argument, fmt::format("line {}: {}", line, what)};
}

}  // namespace

std::string position_line(unsigned step, std::size_t sphere, const Point& position) {
  return fmt::format("{},{},{},{},{}\n", step, sphere, position[0], position[1], position[2]);
}

Result<std::vector<Divergence>> compare_positions(std::string_view first, std::string_view second) {
  if (!take_header(first) || !take_header(second)) {
    return bad_line(1, "this is not a file of positions");
  }
  std::vector<Divergence> all;
  std::vector<double> distances;
  unsigned step = 0;
  for (std::size_t line = 2; !first.empty() || !second.empty(); ++line) {
    if (first.empty() || second.empty()) return bad_line(line, "one of the runs ends here");
    const auto a = take_place(first), b = take_place(second);
    if (!a || !b) return bad_line(line, "this is not a position");
    if (a->step != b->step || a->sphere != b->sphere) {
      return bad_line(line, "the runs differ in their steps or spheres");
    }
    if (a->step != step && !distances.empty()) {
      all.push_back(summarize_step(step, distances));
      distances.clear();
    }
    step = a->step;
    distances.push_back(distance(a->position, b->position));
  }
  if (!distances.empty()) all.push_back(summarize_step(step, distances));
  return all;
}

std::string divergence_svg(const std::vector<Divergence>& divergence, const std::string& caption) {
  ChartLine median{"median", {}}, largest{"largest", {}};
  double low = kHighest, high = kLowest;
  unsigned last = 1;
  for (const Divergence& at : divergence) {
    const double step = at.step;
    last = std::max(last, at.step);
    for (const auto& [value, line] :
         {std::pair(at.median, &median), std::pair(at.largest, &largest)}) {
      if (!(value > 0)) continue;
      line->points.push_back({step, value});
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (low > high) std::swap(low, high);
  Chart chart{{0, static_cast<double>(last), false}, decades_around(low, high), caption, {}};
  chart.lines = {std::move(median), std::move(largest)};
  return to_svg(chart);
}

}  // namespace harpoon::bench
