// Bodies from JSON. The text is parsed as it comes and no value is kept but the bodies; a text that
// is something else ends at its first byte that shows it.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "apps/detect/bodies_file.hpp"
#include "apps/detect/body_fields.hpp"
#include "apps/printable.hpp"

namespace harpoon::app {
namespace {

/// The parser's name for a number beyond the range of double.
constexpr int kNumberOverflow = 406;

/// Builds bodies while the JSON text is parsed, so that an error has a place in the text. Refuses
/// at once what would nest deeper than `kMostJsonDepth`.
class JsonHandler final : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit JsonHandler(const TextSource& source) : source_(source) {}

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
      body_ = {};
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
    const auto field = field_of(name);
    if (!in_body_) {
      if (name == "bodies") return true;
      if (field) return fail("this is one body, perhaps JSON lines; put the bodies into an array");
      return fail(fmt::format("unknown key {}; expected \"bodies\"", in_quotes(name)));
    }
    if (!field) {
      return fail(
          fmt::format("unknown key {}; known are {}", in_quotes(name), fmt::join(kFields, ", ")));
    }
    field_ = *field;
    if (seen_[field_]) return fail(fmt::format("{} is there twice", in_quotes(name)));
    seen_[field_] = true;
    return true;
  }
  bool end_object() override {
    if (!in_body_) return true;
    for (std::size_t f = 0; f < kNumbers; ++f) {
      if (!seen_[f]) return fail(fmt::format("body {} has no \"{}\"", bodies_.size(), kFields[f]));
    }
    in_body_ = false;
    if (bodies_.append(body_, seen_[kGroup] || seen_[kMask])) return true;
    return fail(fmt::format("more than {} bodies", kMaxBodies));
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
  bool parse_error(std::size_t, const std::string& token,
                   const nlohmann::detail::exception& what) override {
    if (error_) return false;
    const std::string message = what.id == kNumberOverflow
                                    ? fmt::format(": {} is too large", in_quotes(token))
                                    : what.what();
    const std::size_t colon = message.find(": ");
    return fail(colon == std::string::npos ? message : message.substr(colon + 2));
  }

  bool fail(std::string reason) {
    error_ = TextError{source_.line(), source_.column(), std::move(reason)};
    return false;
  }

  BodiesOrError result() {
    if (!error_ && !had_list_) fail("there is no array of bodies");
    if (error_) return *error_;
    return bodies_.take();
  }

 private:
  bool refuse(const char* what) { return fail(fmt::format("{} is out of place here", what)); }

  bool number(double value, bool whole, std::uint64_t bits) {
    if (!in_body_) return refuse("a number");
    if (field_ < kNumbers) {
      body_.numbers[field_] = value;
      return true;
    }
    if (!whole || bits > 0xFFFFFFFFU) {
      return fail(fmt::format("{} must be a whole number of 32 bits", kFields[field_]));
    }
    (field_ == kGroup ? body_.group : body_.mask) = static_cast<std::uint32_t>(bits);
    return true;
  }

  const TextSource& source_;
  std::optional<TextError> error_;
  BodyList bodies_;
  BodyFields body_;
  std::array<bool, kFields.size()> seen_ = {};
  std::size_t field_ = 0;
  bool in_object_ = false, in_list_ = false, had_list_ = false, in_body_ = false;
};

/// Thrown through the parser, which collects a token, and the blanks before it, until it tells of
/// it.
struct TooLong {
  const char* what;
  std::size_t most;
};

/// How long the token is that is being read: what stands between quotes, or without blanks and
/// punctuation; and how long the blanks are.
class TokenLength {
 public:
  void add(char c) {
    const bool is_blank = !in_text_ && (c == ' ' || c == '\n' || c == '\r' || c == '\t');
    const bool ends =
        is_blank ||
        (!in_text_ && (c == ',' || c == ':' || c == '[' || c == ']' || c == '{' || c == '}'));
    if (c == '"' && !is_escaped_) in_text_ = !in_text_;
    is_escaped_ = in_text_ && c == '\\' && !is_escaped_;
    length_ = ends ? 0 : length_ + 1;
    blanks_ = is_blank ? blanks_ + 1 : 0;
    if (length_ > kMostTokenBytes) throw TooLong{"a name, number or text", kMostTokenBytes};
    if (blanks_ > kMostLineBytes) throw TooLong{"blanks", kMostLineBytes};
  }

 private:
  std::size_t length_ = 0, blanks_ = 0;
  bool in_text_ = false, is_escaped_ = false;
};

/// Iterates over the source; at its end it equals one without a source.
class SourceIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  SourceIterator() = default;
  SourceIterator(TextSource& source, TokenLength& token) : source_(&source), token_(&token) {}
  reference operator*() const { return source_->peek(); }
  SourceIterator& operator++() {
    token_->add(source_->peek());
    source_->advance();
    return *this;
  }
  SourceIterator operator++(int) {
    SourceIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const SourceIterator& other) const { return is_at_end() == other.is_at_end(); }
  bool operator!=(const SourceIterator& other) const { return !(*this == other); }

 private:
  [[nodiscard]] bool is_at_end() const { return source_ == nullptr || !source_->has_next(); }

  TextSource* source_ = nullptr;
  TokenLength* token_ = nullptr;
};

}  // namespace

BodiesOrError read_bodies_json(TextSource& source) {
  if (const auto wrong = wrong_beginning(source.look_ahead())) return *wrong;
  JsonHandler handler(source);
  TokenLength token;
  try {
    nlohmann::json::sax_parse(SourceIterator(source, token), SourceIterator(), &handler);
  } catch (const TooLong& too_long) {
    handler.fail(fmt::format("{} of more than {} bytes", too_long.what, too_long.most));
  }
  return handler.result();
}

}  // namespace harpoon::app
