#include "broad/survey.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace harpoon::broad {
namespace {

/// Fewest bodies of a piece of work.
constexpr std::size_t kPieceBodies = 4096;
/// Radii this close share a class.
constexpr double kOneClassRatio = 1.5;

// ---- Where most bodies are.

/// Most bodies looked at to find out where bodies are, and one in how many.
constexpr std::size_t kSamples = 256;
constexpr std::size_t kBodiesPerSample = 16;
/// Fewer say nothing about the bodies at large.
constexpr std::size_t kFewestSamples = 16;
/// The part of a sample that may lie far away at either end of an axis.
constexpr std::size_t kTail = 16;
/// How much wider than most bodies the core may be, at either end of an axis: by a part of their
/// width, and by reaches of a usual body.
constexpr double kCoreWidening = 0.25;
constexpr double kCoreBorder = 8;
/// The core is taken for the world when the world is so many times larger.
constexpr double kWorthACore = 4;

// ---- Who is a giant.

/// Size classes that are told apart below the largest body.
constexpr std::size_t kWideClasses = 256;
/// A giant is so many times larger than all but one in kUsualPart of the bodies,
constexpr double kGiantRatio = 32;
constexpr std::size_t kUsualPart = 16;
/// its radius at least such a part of the core's longest side,
constexpr double kGiantOfCore = 1.0 / 16;
/// and there are no more than kGiantsOfRoot times the square root of the bodies, because all pairs
/// of giants are tested. More of them are a case for trees.
constexpr double kGiantsOfRoot = 8;

template <class Real>
void merge(Extremes<Real>& into, const Extremes<Real>& from) noexcept {
  for (int k = 0; k < 4; ++k) {
    into.min[k] = std::min(into.min[k], from.min[k]);
    into.max[k] = std::max(into.max[k], from.max[k]);
  }
  into.invalid += from.invalid;
}

enum class Steps : std::uint8_t { even, uneven };

/// Some of the valid bodies, axis by axis and radii last. Even steps may fall in with the order of
/// ids, as where every second body is of one kind.
template <class Real>
class Sample {
 public:
  Sample(const Source<Real>& source, Steps steps) noexcept {
    const std::size_t step =
        std::max(std::min(source.count, kBodiesPerSample), source.count / kSamples);
    std::uint32_t state = 0;
    for (std::size_t first = 0; first < source.count && count_ < kSamples; first += step) {
      state = state * 1664525U + 1013904223U;
      const std::size_t skip = steps == Steps::even ? 0 : (std::uint64_t{state} * step) >> 32;
      const std::size_t i = std::min(first + skip, source.count - 1);
      const SphereOf<Real> b = source[i];
      if (!is_valid(b)) continue;
      const Real fields[4] = {b.x, b.y, b.z, b.r};
      for (std::size_t k = 0; k < 4; ++k) fields_[k][count_] = fields[k];
      ++count_;
    }
  }

  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  /// The one with `rank` smaller ones before it.
  [[nodiscard]] double ranked(std::size_t field, std::size_t rank) noexcept {
    Real* const begin = fields_[field];
    std::nth_element(begin, begin + rank, begin + count_);
    return static_cast<double>(begin[rank]);
  }

  /// Length of an axis near which bodies are, of [low, high]: long gaps count as short ones.
  [[nodiscard]] double occupied_length(std::size_t axis, double low, double high,
                                       double longest_gap) noexcept {
    Real* const begin = fields_[axis];
    std::sort(begin, begin + count_);
    double length = 0;
    for (std::size_t k = 1; k < count_; ++k) {
      const auto from = static_cast<double>(begin[k - 1]);
      const auto to = static_cast<double>(begin[k]);
      if (from >= low && to <= high) length += std::min(to - from, longest_gap);
    }
    return length;
  }

 private:
  Real fields_[4][kSamples];
  std::size_t count_ = 0;
};

/// Bodies of each class, and the largest radius among them, in a part of the bodies.
template <class Real>
class ClassCounts {
 public:
  void count(const Source<Real>& source, int top, bool all_valid, std::size_t begin,
             std::size_t end) noexcept {
    for (std::size_t i = begin; i < end; ++i) {
      const SphereOf<Real> b = source[i];
      if (!all_valid && !is_valid(b)) continue;
      // Neighbours count apart, or each would wait for the one before it.
      const auto c = std::min(static_cast<std::size_t>(top - exponent_of(b.r)), kWideClasses - 1);
      Class& of = classes_[i % kTurns][c];
      ++of.bodies;
      of.max_radius = std::max(of.max_radius, b.r);
    }
  }

  void add_to(std::array<RadiusClass, kWideClasses>& classes) const noexcept {
    for (const auto& turn : classes_) {
      for (std::size_t c = 0; c < kWideClasses; ++c) {
        classes[c].bodies += turn[c].bodies;
        classes[c].max_radius =
            std::max(classes[c].max_radius, static_cast<double>(turn[c].max_radius));
      }
    }
  }

 private:
  static constexpr std::size_t kTurns = 4;
  struct Class {
    std::uint32_t bodies = 0;
    Real max_radius = 0;
  };
  std::array<std::array<Class, kWideClasses>, kTurns> classes_ = {};
};

/// One survey under way.
template <class Real>
class Surveyor {
 public:
  Surveyor(const Means& means, const Source<Real>& source, double margin, Survey<Real>& out)
      : means_(means), source_(source), out_(out) {
    out_.census.margin = margin;
    out_.census.real_digits = std::numeric_limits<Real>::digits;
  }

  std::optional<Error> run(std::vector<std::uint32_t>& excluded) {
    if (auto error = find_extremes({}, out_.extremes)) return error;
    const Extremes<Real>& extremes = out_.extremes;
    if (extremes.invalid != 0) {
      for (std::size_t i = 0; i < source_.count; ++i) {
        if (!is_valid(source_[i])) excluded.push_back(static_cast<std::uint32_t>(i));
      }
    }
    Census& census = out_.census;
    census.bodies = source_.count - extremes.invalid;
    if (census.bodies == 0) return std::nullopt;
    if (auto error = find_core()) return error;
    if (auto error = count_classes()) return error;
    for (int k = 0; k < 3; ++k) census.occupied[k] = census.max[k] - census.min[k];
    if (is_sparse(census)) {
      const double gap = 8 * (2 * static_cast<double>(out_.largest) + census.margin);
      Sample<Real> sample(source_, Steps::even);
      for (std::size_t k = 0; k < 3; ++k) {
        census.occupied[k] = sample.occupied_length(k, census.min[k], census.max[k], gap);
      }
    }
    return std::nullopt;
  }

 private:
  std::optional<Error> find_extremes(const Limits<Real>& limits, Extremes<Real>& out) {
    const auto& kernels = means_.kernels->of<Real>();
    std::array<Extremes<Real>, Means::kMaxPieces> found;
    if (auto error = means_.run_pieces(source_.count, kPieceBodies,
                                       [&](std::size_t piece, std::size_t begin, std::size_t end) {
                                         found[piece] =
                                             kernels.extremes(source_, limits, begin, end);
                                       })) {
      return error;
    }
    out = found[0];
    const std::size_t pieces = means_.pieces(source_.count, kPieceBodies);
    for (std::size_t p = 1; p < pieces; ++p) merge(out, found[p]);
    return std::nullopt;
  }

  /// Where all but a few bodies are: the whole world, unless that is mostly empty.
  std::optional<Error> find_core() {
    Census& census = out_.census;
    take_bounds(out_.extremes);
    if (census.bodies < kFewestSamples * kBodiesPerSample) return std::nullopt;
    Sample<Real> sample(source_, Steps::uneven);
    if (sample.count() < kFewestSamples) return std::nullopt;
    const double reach = 2 * sample.ranked(3, sample.count() / 2) + census.margin;
    if (!is_roomy(reach)) return std::nullopt;
    const std::size_t tail = sample.count() / kTail;
    const double least = std::max(reach, std::numeric_limits<double>::min());
    Limits<Real> core;
    double ratio = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double first = sample.ranked(k, tail);
      const double last = sample.ranked(k, sample.count() - 1 - tail);
      const double border = kCoreWidening * (last - first) + kCoreBorder * reach;
      const double low = std::max(census.min[k], first - border);
      const double high = std::min(census.max[k], last + border);
      core.low[k] = static_cast<Real>(low);
      core.high[k] = static_cast<Real>(high);
      ratio *= (census.max[k] - census.min[k] + least) / (high - low + least);
    }
    if (!(ratio >= kWorthACore)) return std::nullopt;
    Extremes<Real> within;
    if (auto error = find_extremes(core, within)) return error;
    take_bounds(within);
    census.bodies_beyond = true;
    return std::nullopt;
  }

  void take_bounds(const Extremes<Real>& extremes) noexcept {
    for (int k = 0; k < 3; ++k) {
      out_.census.min[k] = static_cast<double>(extremes.min[k]);
      out_.census.max[k] = static_cast<double>(extremes.max[k]);
    }
  }

  /// Whether bodies of such a reach must leave most of the world empty.
  [[nodiscard]] bool is_roomy(double reach) const noexcept {
    double cells = 1;
    for (int k = 0; k < 3; ++k) {
      cells *= (out_.census.max[k] - out_.census.min[k]) / (2 * reach) + 1;
    }
    return !(cells <= 2 * static_cast<double>(out_.census.bodies));
  }

  std::optional<Error> count_classes() {
    const Extremes<Real>& extremes = out_.extremes;
    Census& census = out_.census;
    out_.largest = extremes.max[3];
    out_.one_class = static_cast<double>(extremes.max[3]) <=
                     kOneClassRatio * static_cast<double>(extremes.min[3]);
    if (out_.one_class) {
      census.classes[0] = {census.bodies, static_cast<double>(extremes.max[3])};
      return std::nullopt;
    }
    const int top = exponent_of(extremes.max[3]);
    std::vector<ClassCounts<Real>> counts(means_.pieces(source_.count, kPieceBodies));
    if (auto error = means_.run_pieces(source_.count, kPieceBodies,
                                       [&](std::size_t piece, std::size_t begin, std::size_t end) {
                                         counts[piece].count(source_, top, extremes.invalid == 0,
                                                             begin, end);
                                       })) {
      return error;
    }
    std::array<RadiusClass, kWideClasses> classes;
    for (const ClassCounts<Real>& piece : counts) piece.add_to(classes);
    std::size_t first = count_giants(classes);
    if (first != 0) take_out_giants(top - static_cast<int>(first) + 1);
    while (classes[first].bodies == 0) ++first;
    out_.largest = static_cast<Real>(classes[first].max_radius);
    for (std::size_t c = first; c < kWideClasses; ++c) {
      RadiusClass& to = census.classes[std::min(c - first, kRadiusClasses - 1)];
      to.bodies += classes[c].bodies;
      to.max_radius = std::max(to.max_radius, classes[c].max_radius);
    }
    return std::nullopt;
  }

  /// How many of the classes are giants.
  [[nodiscard]] std::size_t count_giants(
      const std::array<RadiusClass, kWideClasses>& classes) noexcept {
    const Census& census = out_.census;
    std::size_t larger = 0;
    double usual = 0;
    for (const RadiusClass& c : classes) {
      larger += c.bodies;
      usual = c.max_radius;
      if (larger > census.bodies / kUsualPart) break;
    }
    const double core = std::max({census.max[0] - census.min[0], census.max[1] - census.min[1],
                                  census.max[2] - census.min[2]});
    const double least = std::max(kGiantRatio * usual, kGiantOfCore * core);
    const double most = kGiantsOfRoot * std::sqrt(static_cast<double>(census.bodies));
    double giants = 0;
    for (std::size_t c = 0; c < kWideClasses; ++c) {
      if (classes[c].bodies != 0 && !(classes[c].max_radius > least)) {
        out_.census.giants_abound = giants > most;
        return out_.census.giants_abound ? 0 : c;
      }
      giants += static_cast<double>(classes[c].bodies);
    }
    return 0;
  }

  /// Those whose radius has at least that exponent.
  void take_out_giants(int least) {
    Census& census = out_.census;
    for (std::size_t i = 0; i < source_.count; ++i) {
      const SphereOf<Real> b = source_[i];
      if (exponent_of(b.r) < least || !is_valid(b)) continue;
      out_.giants.push_back(static_cast<std::uint32_t>(i));
      census.giant_distance = std::max(census.giant_distance, distance_where_near(b));
    }
    census.giants = out_.giants.size();
    census.bodies -= census.giants;
  }

  /// How far along an axis a giant is from the core, if it comes near it.
  [[nodiscard]] double distance_where_near(const SphereOf<Real>& b) const noexcept {
    const Census& census = out_.census;
    const double at[3] = {static_cast<double>(b.x), static_cast<double>(b.y),
                          static_cast<double>(b.z)};
    double farthest = 0;
    double square = 0;
    for (int k = 0; k < 3; ++k) {
      const double away = std::max({census.min[k] - at[k], at[k] - census.max[k], 0.0});
      farthest = std::max(farthest, away);
      square += away * away;
    }
    const double reach = static_cast<double>(b.r) * (1 + 2 * kFarPad) + farthest * 2 * kFarPad;
    return std::sqrt(square) <= reach ? farthest : 0;
  }

  const Means& means_;
  const Source<Real>& source_;
  Survey<Real>& out_;
};

}  // namespace

template <class Real>
std::optional<Error> survey(const Means& means, const Source<Real>& source, double margin,
                            std::vector<std::uint32_t>& excluded, Survey<Real>& out) {
  return Surveyor<Real>(means, source, margin, out).run(excluded);
}

template <class Real>
double usual_radius(const Source<Real>& source) noexcept {
  Sample<Real> sample(source, Steps::uneven);
  const std::size_t count = sample.count();
  return count == 0 ? 0 : sample.ranked(3, count - 1 - count / kUsualPart);
}

template double usual_radius(const Source<float>&) noexcept;
template double usual_radius(const Source<double>&) noexcept;
template std::optional<Error> survey(const Means&, const Source<float>&, double,
                                     std::vector<std::uint32_t>&, Survey<float>&);
template std::optional<Error> survey(const Means&, const Source<double>&, double,
                                     std::vector<std::uint32_t>&, Survey<double>&);

}  // namespace harpoon::broad
