// Bodies from CSV: commas between fields, numbers as C writes them, no quotes. What else programs
// write under that name is told apart, so that a message can say what it is.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <cstdlib>

#include "apps/detect/bodies_file.hpp"
#include "apps/detect/body_fields.hpp"
#include "apps/printable.hpp"

namespace harpoon::app {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// What is wrong with a text that should be a number, or null.
using Fault = const char*;

/// Why `text` is no number, as far as that is a habit of some program.
Fault why_no_number(std::string_view text) {
  if (text.empty()) return "is not a number but empty";
  if (has(text, "\"") || text.front() == '\'') return "is not a number: write it without quotes";
  if (has(text, "\xE2\x88\x92")) return "is not a number: its minus sign is not that of ASCII";
  if (has(text, "\xC2\xA0") || has(text, "\xE2\x80\xAF")) {
    return "is not a number: it has a no-break space";
  }
  const std::size_t exponent = text.find_first_of("dD");
  const bool is_fortran = exponent != std::string_view::npos && exponent > 0 &&
                          text.find_first_not_of("0123456789.+-dD") == std::string_view::npos;
  if (is_fortran) return "is not a number: write the exponent with E, not Fortran's D";
  if (has(text, "'") || has(text, "_")) return "is not a number: it has separators of thousands";
  if (has(text, ";")) return "is not a number: fields are separated by commas, not semicolons";
  if (has(text, "\t") || has(text, " ")) {
    return "is not a number: fields are separated by commas, not spaces";
  }
  return "is not a number";
}

/// The whole of `text` as a number; "nan" and "inf" are numbers, and what is too small is 0.
Fault parse(std::string_view text, double& out) {
  std::string_view digits = text;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  const char* const all = digits.data() + digits.size();
  const auto [end, error] = std::from_chars(digits.data(), all, out);
  if (digits.empty() || end != all || error == std::errc::invalid_argument) {
    return why_no_number(text);
  }
  if (error != std::errc::result_out_of_range) return nullptr;
  out = std::strtod(std::string(digits).c_str(), nullptr);
  return std::isfinite(out) ? nullptr : "is too large";
}

Fault parse(std::string_view text, std::uint32_t& out) {
  const char* const all = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), all, out);
  const bool parsed = error == std::errc() && end == all && !text.empty();
  return parsed ? nullptr : "is not a whole number of 32 bits";
}

/// What a text is that begins as no CSV does: JSON, which may be one line.
const char* json_kind(std::string_view beginning) {
  const std::size_t first = beginning.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return nullptr;
  const std::string_view text = beginning.substr(first);
  if (text.front() == '{' && trimmed(text.substr(0, text.find('\n'))).back() == '}') {
    return "this is JSON, or JSON lines with a value on each line; put the bodies into one array "
           "in a file named .json";
  }
  const bool is_json = text.front() == '{' || text.front() == '[';
  return is_json ? "this is JSON; give the file a name that ends with .json" : nullptr;
}

/// What a header without any of our names is instead.
std::string other_header(std::string_view line) {
  const std::string_view text = trimmed(line);
  if (text.starts_with("ITEM:")) return "this is a LAMMPS dump; write x,y,z,r as CSV";
  if (text.front() == '<') return "this is XML or HTML; write CSV";
  if (has(text, ",")) return "";
  for (const auto& [separator, name] : {std::pair{';', "semicolons"}, std::pair{'\t', "tabs"},
                                        std::pair{'|', "bars"}, std::pair{' ', "spaces"}}) {
    if (text.find(separator) != std::string_view::npos) {
      return fmt::format("fields are separated by {} here; separate them by commas", name);
    }
  }
  return "";
}

/// Lines of a CSV text and where one is in them.
class CsvReader {
 public:
  explicit CsvReader(TextSource& source) : source_(source) {}

  BodiesOrError read() {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    const std::string_view beginning = source_.look_ahead();
    if (const auto wrong = wrong_beginning(beginning)) return *wrong;
    if (const char* const kind = json_kind(beginning)) return TextError{1, 1, kind};
    if (has(beginning, "\r") && !has(beginning, "\n")) {
      return TextError{1, beginning.find('\r') + 1,
                       "lines end with CR alone here; end them with LF or CR LF"};
    }
    if (beginning.starts_with(kByteOrderMark)) source_.skip(kByteOrderMark.size());
    while (next_line()) {
      if (!(columns_.empty() ? read_header() : read_body())) break;
    }
    if (error_) return *error_;
    if (columns_.empty()) {
      return TextError{1, 1, "there is no header; the first line must name x,y,z,r"};
    }
    return bodies_.take();
  }

 private:
  /// The next line with something on it.
  bool next_line() {
    while (true) {
      const TextSource::Line next = source_.next_line(line_);
      if (next == TextSource::Line::none) return false;
      if (next == TextSource::Line::too_long) {
        return fail(
            kMostLineBytes + 1,
            fmt::format("a line of more than {} bytes; a body is on one line", kMostLineBytes));
      }
      if (const std::size_t zero = line_.find('\0'); zero != std::string_view::npos) {
        return fail(zero + 1, "this is binary data, not a text");
      }
      const std::string_view content = trimmed(line_);
      if (!content.empty() && content.front() != '#') return true;
    }
  }

  /// Calls visit(index, text, column) for each field; stops when it returns false.
  template <class Visit>
  bool each_field(const Visit& visit) {
    std::size_t begin = 0;
    for (std::size_t index = 0;; ++index) {
      const std::size_t end = std::min(line_.find(',', begin), line_.size());
      if (end - begin > kMostTokenBytes) {
        return fail(begin + 1, fmt::format("a field of more than {} bytes", kMostTokenBytes));
      }
      if (!visit(index, trimmed(line_.substr(begin, end - begin)), begin + 1)) return false;
      if (end == line_.size()) return true;
      begin = end + 1;
    }
  }

  bool fail(std::size_t column, std::string reason) {
    error_ = {source_.line(), column, std::move(reason)};
    return false;
  }

  bool refuse_name(std::string_view name, std::size_t column) {
    std::string other = other_header(line_);
    if (!other.empty()) return fail(1, std::move(other));
    if (has(name, "\"")) {
      return fail(column, fmt::format("{} is quoted; write names and numbers without quotes",
                                      in_quotes(name)));
    }
    double number = 0;
    if (parse(name, number) == nullptr) {
      return fail(1, "there is no header; the first line must name x,y,z,r");
    }
    if (name.empty() && column > line_.size()) {
      return fail(column, "the header ends with a comma; end no line with one");
    }
    return fail(column, fmt::format("unknown column {}; known are {}", in_quotes(name),
                                    fmt::join(kFields, ", ")));
  }

  bool read_header() {
    std::array<bool, kFields.size()> seen = {};
    const bool read = each_field([&](std::size_t, std::string_view name, std::size_t column) {
      const auto field = field_of(name);
      if (!field) return refuse_name(name, column);
      if (seen[*field])
        return fail(column, fmt::format("column {} is there twice", in_quotes(name)));
      seen[*field] = true;
      columns_.push_back(*field);
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
    BodyFields body;
    std::size_t fields = 0;
    const bool read = each_field([&](std::size_t i, std::string_view text, std::size_t column) {
      ++fields;
      if (i >= columns_.size()) {
        const char* const hint =
            text.empty() && column > line_.size() ? "; end no line with a comma" : "";
        return fail(column, fmt::format("more than {} fields{}", columns_.size(), hint));
      }
      const std::size_t field = columns_[i];
      const Fault fault = field < kNumbers  ? parse(text, body.numbers[field])
                          : field == kGroup ? parse(text, body.group)
                                            : parse(text, body.mask);
      if (fault == nullptr) return true;
      return fail(column, fmt::format("{} for {} {}", in_quotes(text), kFields[field], fault));
    });
    if (!read) return false;
    if (fields < columns_.size()) {
      return fail(line_.size() + 1,
                  fmt::format("{} fields where the header has {}", fields, columns_.size()));
    }
    if (!bodies_.append(body, ruled_)) {
      return fail(1, fmt::format("more than {} bodies", kMaxBodies));
    }
    return true;
  }

  TextSource& source_;
  std::string_view line_;
  std::vector<std::size_t> columns_;
  bool ruled_ = false;
  BodyList bodies_;
  std::optional<TextError> error_;
};

}  // namespace

BodiesOrError read_bodies_csv(TextSource& source) {
  return CsvReader(source).read();
}

}  // namespace harpoon::app
