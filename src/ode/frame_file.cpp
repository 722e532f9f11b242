#include "ode/frame_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>

#include "ode/pair_search.hpp"

namespace harpoon::ode {
namespace {

constexpr std::string_view kTitle = "harpoon-ode-frame 1";
constexpr std::size_t kMostGeoms = std::size_t{1} << 26;

/// Takes words off a text, line by line.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  [[nodiscard]] bool failed() const { return failed_; }
  [[nodiscard]] std::size_t line() const { return line_; }
  void fail() { failed_ = true; }

  std::string_view rest_of_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view rest = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    ++line_;
    return rest;
  }
  std::string_view word() {
    if (failed_) return {};  // the line stays that of the first failure
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) {
      if (text_[at_++] == '\n') ++line_;
    }
    const std::size_t end = std::min(text_.find_first_of(" \n", at_), text_.size());
    const std::string_view word = text_.substr(at_, end - at_);
    at_ = end;
    if (word.empty()) failed_ = true;
    return word;
  }
  void expect(std::string_view name) {
    if (word() != name) failed_ = true;
  }
  template <class Integer>
  Integer integer() {
    const std::string_view text = word();
    Integer value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) failed_ = true;
    return value;
  }
  double number() {
    const std::string text(word());
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || end != text.c_str() + text.size()) failed_ = true;
    return value;
  }
  /// A count that the rest of the text has room for.
  std::size_t count() {
    const auto value = integer<std::size_t>();
    if (value > kMostGeoms || value > text_.size()) failed_ = true;
    return failed_ ? 0 : value;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
  bool failed_ = false;
};

void append_pairs(std::string& text, std::string_view name, std::span<const IndexPair> pairs) {
  fmt::format_to(std::back_inserter(text), "{} {}\n", name, pairs.size());
  for (const IndexPair& pair : pairs) {
    fmt::format_to(std::back_inserter(text), "{} {}\n", pair.g1, pair.g2);
  }
}

std::vector<IndexPair> read_pairs(Reader& reader, std::string_view name, std::size_t geoms) {
  reader.expect(name);
  std::vector<IndexPair> pairs(reader.count());
  for (IndexPair& pair : pairs) {
    pair.g1 = reader.integer<std::uint32_t>();
    pair.g2 = reader.integer<std::uint32_t>();
    if (pair.g1 >= geoms || pair.g2 >= geoms) reader.fail();
    if (reader.failed()) break;
  }
  return pairs;
}

FrameGeom read_geom(Reader& reader) {
  FrameGeom geom;
  geom.class_number = reader.integer<int>();
  geom.body = reader.integer<std::uint32_t>();
  geom.category = reader.integer<std::uint64_t>();
  geom.collide = reader.integer<std::uint64_t>();
  for (double& bound : geom.bounds) bound = reader.number();
  return geom;
}

template <class Real>
Mirror<Real> mirror_of(const CollisionFrame& frame) {
  Mirror<Real> mirror;
  mirror.uniform_bits = false;
  for (const FrameGeom& geom : frame.geoms) {
    BoundsBox<Real> box;
    std::uint8_t traits = 0;
    for (int side = 0; side < 6; ++side) {
      box.v[side] = static_cast<Real>(geom.bounds[side]);
      if (std::isnan(box.v[side])) traits |= kIsNan;
      if (side % 2 != 0 && box.v[side - 1] > box.v[side]) traits |= kIsInverted;
    }
    mirror.geoms.push_back(nullptr);
    mirror.bounds.push_back(box);
    // Only equality counts.
    mirror.bodies.push_back(
        reinterpret_cast<const dxBody*>(static_cast<std::uintptr_t>(geom.body) * alignof(double)));
    mirror.category.push_back(geom.category);
    mirror.collide.push_back(geom.collide);
    mirror.traits.push_back(traits);
    mirror.all_traits |= traits;
  }
  return mirror;
}

template <class Real>
Result<std::vector<IndexPair>> search_mirror(const CollisionFrame& frame) {
  const Mirror<Real> mirror = mirror_of<Real>(frame);
  Result<PairSearch<Real>> search = PairSearch<Real>::make();
  if (!search) return search.error();
  std::vector<IndexPair> pairs;
  Result<typename PairSearch<Real>::Found> found = typename PairSearch<Real>::Found{};
  if (frame.kind == geom_class::kSimpleSpace) {
    found = search->find_simple(mirror, pairs);
  } else if (frame.kind == geom_class::kHashSpace) {
    found = search->find_hash(mirror, frame.min_level, frame.max_level, frame.policy, pairs);
  } else {
    SapOrder<Real> sap(frame.axis_order);
    found = search->find_sap(mirror, sap, pairs);
  }
  if (!found) return found.error();
  return pairs;
}

}  // namespace

std::string to_text(const CollisionFrame& frame) {
  std::string text = fmt::format(
      "{}\n{}\nsingle {} policy {} space {} levels {} {} axes {}\ngeoms {}\n", kTitle,
      frame.difference, frame.single_precision ? 1 : 0, static_cast<int>(frame.policy), frame.kind,
      frame.min_level, frame.max_level, frame.axis_order, frame.geoms.size());
  for (const FrameGeom& geom : frame.geoms) {
    fmt::format_to(std::back_inserter(text), "{} {} {} {}", geom.class_number, geom.body,
                   geom.category, geom.collide);
    for (const double bound : geom.bounds) fmt::format_to(std::back_inserter(text), " {:a}", bound);
    text += '\n';
  }
  append_pairs(text, "ours", frame.ours);
  append_pairs(text, "stock", frame.stock);
  return text;
}

Result<CollisionFrame> parse_frame(std::string_view text) {
  Reader reader(text);
  CollisionFrame frame;
  if (reader.rest_of_line() != kTitle) {
    return Error{Errc::invalid_argument,
                 fmt::format("this is no recorded frame: line 1 is not \"{}\"", kTitle)};
  }
  frame.difference = reader.rest_of_line();
  reader.expect("single");
  frame.single_precision = reader.integer<int>() != 0;
  reader.expect("policy");
  const int policy = reader.integer<int>();
  if (policy < 0 || policy > static_cast<int>(Policy::strict)) reader.fail();
  frame.policy = static_cast<Policy>(policy);
  reader.expect("space");
  frame.kind = reader.integer<int>();
  if (frame.kind < geom_class::kSimpleSpace || frame.kind > geom_class::kSapSpace) reader.fail();
  reader.expect("levels");
  frame.min_level = reader.integer<int>();
  frame.max_level = reader.integer<int>();
  reader.expect("axes");
  frame.axis_order = reader.integer<int>();
  if (!SapOrder<double>(frame.axis_order).usable() && frame.kind == geom_class::kSapSpace) {
    reader.fail();
  }
  reader.expect("geoms");
  frame.geoms.resize(reader.count());
  for (FrameGeom& geom : frame.geoms) {
    geom = read_geom(reader);
    if (reader.failed()) break;
  }
  if (!reader.failed()) frame.ours = read_pairs(reader, "ours", frame.geoms.size());
  if (!reader.failed()) frame.stock = read_pairs(reader, "stock", frame.geoms.size());
  if (reader.failed()) {
    return Error{
        Errc::invalid_argument,
        fmt::format("line {} of the recorded frame is not what belongs there", reader.line())};
  }
  return frame;
}

Result<std::vector<IndexPair>> search_again(const CollisionFrame& frame) {
  return frame.single_precision ? search_mirror<float>(frame) : search_mirror<double>(frame);
}

}  // namespace harpoon::ode
