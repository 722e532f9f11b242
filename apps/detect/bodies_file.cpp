#include "apps/detect/bodies_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>

namespace harpoon::app {
namespace {

constexpr std::array<std::string_view, 6> kFields = {"x", "y", "z", "r", "group", "mask"};
constexpr std::size_t kNumbers = 4;  // of kFields; the others are bits
constexpr std::size_t kGroup = 4;
constexpr std::size_t kMask = 5;
/// Bytes between two calls of the progress.
constexpr std::size_t kProgressBytes = std::size_t{1} << 20;

/// Tells how far a text of `bytes` has been read, not too often.
class Pace {
 public:
  Pace(const ReadProgress& progress, std::size_t bytes) : progress_(progress), bytes_(bytes) {}
  void at(std::size_t position) {
    if (!progress_ || position < next_) return;
    progress_(static_cast<double>(position) / static_cast<double>(bytes_));
    next_ = position + kProgressBytes;
  }

 private:
  const ReadProgress& progress_;
  std::size_t bytes_;
  std::size_t next_ = kProgressBytes;
};

/// One body, field by field.
struct Values {
  std::array<double, kNumbers> numbers = {};
  std::uint32_t group = 1;
  std::uint32_t mask = 0xFFFFFFFF;
};

void append(const Values& v, bool ruled, FileBodies& out) {
  out.spheres.push_back({v.numbers[0], v.numbers[1], v.numbers[2], v.numbers[3]});
  if (ruled) {
    out.group.push_back(v.group);
    out.mask.push_back(v.mask);
  }
}

std::string_view trimmed(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

/// What is wrong with a text that should be a number, or null.
using Fault = const char*;

/// The whole of `text` as a number; "nan" and "inf" are numbers, and what is too small is 0.
Fault parse(std::string_view text, double& out) {
  constexpr Fault kNoNumber = "is not a number";
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const char* const all = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), all, out);
  if (text.empty() || end != all || error == std::errc::invalid_argument) return kNoNumber;
  if (error != std::errc::result_out_of_range) return nullptr;
  out = std::strtod(std::string(text).c_str(), nullptr);
  return std::isfinite(out) ? nullptr : "is too large";
}

Fault parse(std::string_view text, std::uint32_t& out) {
  const char* const all = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), all, out);
  const bool parsed = error == std::errc() && end == all && !text.empty();
  return parsed ? nullptr : "is not a whole number of 32 bits";
}

/// Lines of a CSV text and where one is in them.
class CsvReader {
 public:
  explicit CsvReader(std::string_view text) : text_(text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text_.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
      text_.remove_prefix(kByteOrderMark.size());
    }
  }

  BodiesOrError read(const ReadProgress& progress) {
    Pace pace(progress, text_.size());
    while (next_line()) {
      if (!(columns_.empty() ? read_header() : read_body())) return error_;
      pace.at(std::min(position_, text_.size()));
    }
    if (columns_.empty()) {
      return TextError{1, 1, "there is no header; the first line must name x,y,z,r"};
    }
    return std::move(bodies_);
  }

 private:
  /// The next line with something on it.
  bool next_line() {
    while (position_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', position_), text_.size());
      line_ = text_.substr(position_, end - position_);
      position_ = end + 1;
      ++line_number_;
      const std::string_view content = trimmed(line_);
      if (!content.empty() && content.front() != '#') return true;
    }
    return false;
  }

  /// Calls visit(index, text, column) for each field; stops when it returns false.
  template <class Visit>
  bool each_field(const Visit& visit) {
    std::size_t begin = 0;
    for (std::size_t index = 0;; ++index) {
      const std::size_t end = std::min(line_.find(',', begin), line_.size());
      if (!visit(index, trimmed(line_.substr(begin, end - begin)), begin + 1)) return false;
      if (end == line_.size()) return true;
      begin = end + 1;
    }
  }

  bool fail(std::size_t column, std::string reason) {
    error_ = {line_number_, column, std::move(reason)};
    return false;
  }

  bool read_header() {
    std::array<bool, kFields.size()> seen = {};
    const bool read = each_field([&](std::size_t, std::string_view name, std::size_t column) {
      const auto* const field = std::find(kFields.begin(), kFields.end(), name);
      if (field == kFields.end()) {
        return fail(column, fmt::format("unknown column \"{}\"; known are {}", name,
                                        fmt::join(kFields, ", ")));
      }
      const auto index = static_cast<std::size_t>(field - kFields.begin());
      if (seen[index]) return fail(column, fmt::format("column \"{}\" is there twice", name));
      seen[index] = true;
      columns_.push_back(index);
      return true;
    });
    if (!read) return false;
    for (std::size_t f = 0; f < kNumbers; ++f) {
      if (!seen[f]) return fail(1, fmt::format("the header has no column \"{}\"", kFields[f]));
    }
    ruled_ = seen[kGroup] || seen[kMask];
    return true;
  }

  bool read_body() {
    Values values;
    std::size_t fields = 0;
    const bool read = each_field([&](std::size_t i, std::string_view text, std::size_t column) {
      ++fields;
      if (i >= columns_.size()) {
        return fail(column, fmt::format("more than {} fields", columns_.size()));
      }
      const std::size_t field = columns_[i];
      const Fault fault = field < kNumbers  ? parse(text, values.numbers[field])
                          : field == kGroup ? parse(text, values.group)
                                            : parse(text, values.mask);
      if (fault == nullptr) return true;
      return fail(column, fmt::format("\"{}\" {} for {}", text, fault, kFields[field]));
    });
    if (!read) return false;
    if (fields < columns_.size()) {
      return fail(line_.size() + 1,
                  fmt::format("{} fields where the header has {}", fields, columns_.size()));
    }
    append(values, ruled_, bodies_);
    return true;
  }

  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t line_number_ = 0;
  std::string_view line_;
  std::vector<std::size_t> columns_;
  bool ruled_ = false;
  FileBodies bodies_;
  TextError error_;
};

/// The parser's name for a number beyond the range of double.
constexpr int kNumberOverflow = 406;

/// Builds bodies while the JSON text is parsed, so that an error has a place in the text.
class JsonHandler final : public nlohmann::json_sax<nlohmann::json> {
 public:
  JsonHandler(std::string_view text, const ReadProgress& progress)
      : text_(text), pace_(progress, text.size()) {}

  bool null() override { return refuse("null"); }
  bool boolean(bool) override { return refuse("true or false"); }
  bool number_integer(number_integer_t value) override {
    return number(static_cast<double>(value), value >= 0, static_cast<std::uint64_t>(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return number(static_cast<double>(value), true, value);
  }
  bool number_float(number_float_t value, const string_t&) override {
    return number(value, false, 0);
  }
  bool string(string_t&) override { return refuse("a string"); }
  bool binary(binary_t&) override { return refuse("binary data"); }

  bool start_object(std::size_t) override {
    if (in_list_ && !in_body_) {
      in_body_ = true;
      values_ = {};
      seen_ = {};
      return true;
    }
    if (!in_list_ && !in_object_) {
      in_object_ = true;
      return true;
    }
    return refuse("an object");
  }
  bool key(string_t& name) override {
    if (!in_body_) {
      if (name == "bodies") return true;
      return fail(fmt::format("unknown key \"{}\"; expected \"bodies\"", name));
    }
    const auto* const field = std::find(kFields.begin(), kFields.end(), name);
    if (field == kFields.end()) {
      return fail(fmt::format("unknown key \"{}\"; known are {}", name, fmt::join(kFields, ", ")));
    }
    field_ = static_cast<std::size_t>(field - kFields.begin());
    if (seen_[field_]) return fail(fmt::format("\"{}\" is there twice", name));
    seen_[field_] = true;
    return true;
  }
  bool end_object() override {
    if (!in_body_) return true;
    for (std::size_t f = 0; f < kNumbers; ++f) {
      if (!seen_[f]) return fail(fmt::format("body {} has no \"{}\"", all_.size(), kFields[f]));
    }
    in_body_ = false;
    ruled_ = ruled_ || seen_[kGroup] || seen_[kMask];
    all_.push_back(values_);
    pace_.at(position());
    return true;
  }
  bool start_array(std::size_t) override {
    if (in_list_ || had_list_) return refuse("an array");
    in_list_ = had_list_ = true;
    return true;
  }
  bool end_array() override {
    in_list_ = false;
    return true;
  }
  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::detail::exception& what) override {
    if (!error_) {
      error_ = at(position == 0 ? 0 : position - 1, "");
      const std::string message =
          what.id == kNumberOverflow ? fmt::format(": \"{}\" is too large", token) : what.what();
      const std::size_t colon = message.find(": ");
      error_->reason = colon == std::string::npos ? message : message.substr(colon + 2);
    }
    return false;
  }

  BodiesOrError result(std::size_t read_to) {
    if (!error_ && !had_list_) error_ = at(read_to, "there is no array of bodies");
    if (error_) return *error_;
    FileBodies bodies;
    for (const Values& v : all_) append(v, ruled_, bodies);
    return bodies;
  }
  /// Where the parser is, for errors of meaning.
  const char* const* cursor = nullptr;

 private:
  [[nodiscard]] TextError at(std::size_t offset, std::string reason) const {
    TextError e;
    const std::string_view before = text_.substr(0, std::min(offset, text_.size()));
    e.line = 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
    const std::size_t newline = before.rfind('\n');
    e.column = before.size() - (newline == std::string_view::npos ? 0 : newline + 1) + 1;
    e.reason = std::move(reason);
    return e;
  }
  [[nodiscard]] std::size_t position() const {
    return cursor == nullptr ? 0 : static_cast<std::size_t>(*cursor - text_.data());
  }
  bool fail(std::string reason) {
    const std::size_t offset = position();
    error_ = at(offset == 0 ? 0 : offset - 1, std::move(reason));
    return false;
  }
  bool refuse(const char* what) { return fail(fmt::format("{} is out of place here", what)); }

  bool number(double value, bool whole, std::uint64_t bits) {
    if (!in_body_) return refuse("a number");
    if (field_ < kNumbers) {
      values_.numbers[field_] = value;
      return true;
    }
    if (!whole || bits > 0xFFFFFFFFU) {
      return fail(fmt::format("{} must be a whole number of 32 bits", kFields[field_]));
    }
    (field_ == kGroup ? values_.group : values_.mask) = static_cast<std::uint32_t>(bits);
    return true;
  }

  std::string_view text_;
  Pace pace_;
  std::optional<TextError> error_;
  std::vector<Values> all_;
  Values values_;
  std::array<bool, kFields.size()> seen_ = {};
  std::size_t field_ = 0;
  bool in_object_ = false, in_list_ = false, had_list_ = false, in_body_ = false, ruled_ = false;
};

/// Iterates over the text and lets the handler see how far the parser has come.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, const char** seen) : at_(at), seen_(seen) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    ++at_;
    *seen_ = at_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  const char** seen_;
};

}  // namespace

BodiesOrError read_bodies_csv(std::string_view text, const ReadProgress& progress) {
  return CsvReader(text).read(progress);
}

BodiesOrError read_bodies_json(std::string_view text, const ReadProgress& progress) {
  JsonHandler handler(text, progress);
  const char* seen = text.data();
  handler.cursor = &seen;
  const CountingIterator begin(text.data(), &seen);
  const CountingIterator end(text.data() + text.size(), &seen);
  nlohmann::json::sax_parse(begin, end, &handler);
  return handler.result(text.size());
}

}  // namespace harpoon::app
