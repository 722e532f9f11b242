#include "apps/detect/bodies_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "apps/detect/body_fields.hpp"
#include "apps/file_kind.hpp"

namespace harpoon::app {
namespace {

/// A vector grows by half, so that while it moves there are at most two and a half times its
/// elements.
template <class T>
void push(std::vector<T>& all, const T& one) {
  constexpr std::size_t kFewest = 1024;
  if (all.size() == all.capacity()) all.reserve(std::max(kFewest, all.size() + all.size() / 2));
  all.push_back(one);
}

/// The bytes of a text in memory, one call after the other.
ReadBytes bytes_of(std::string_view text) {
  return [text](std::span<char> to) mutable {
    const std::size_t some = std::min(text.size(), to.size());
    if (some != 0) std::memcpy(to.data(), text.data(), some);
    text.remove_prefix(some);
    return some;
  };
}

}  // namespace

std::optional<std::size_t> field_of(std::string_view name) {
  const auto* const field = std::find(kFields.begin(), kFields.end(), name);
  if (field == kFields.end()) return std::nullopt;
  return static_cast<std::size_t>(field - kFields.begin());
}

bool BodyList::append(const BodyFields& body, bool has_rules) {
  if (size() == kMaxBodies) return false;
  if (has_rules && !is_ruled_) {
    bodies_.group.assign(size(), BodyFields{}.group);
    bodies_.mask.assign(size(), BodyFields{}.mask);
    is_ruled_ = true;
  }
  push(bodies_.spheres, {body.numbers[0], body.numbers[1], body.numbers[2], body.numbers[3]});
  if (is_ruled_) {
    push(bodies_.group, body.group);
    push(bodies_.mask, body.mask);
  }
  return true;
}

std::optional<TextError> wrong_beginning(std::string_view look_ahead) {
  const std::string kind = other_than_text(look_ahead);
  if (kind.empty()) return std::nullopt;
  TextError error{1, 1, fmt::format("this is {}", kind)};
  if (kind.starts_with("binary")) {
    const std::string_view before = look_ahead.substr(0, look_ahead.find('\0'));
    error.line += static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
    error.column += before.size() - (before.rfind('\n') + 1);
  }
  return error;
}

BodiesOrError read_bodies_csv(std::string_view text, const ReadProgress& progress) {
  TextSource source(bytes_of(text), text.size(), progress);
  return read_bodies_csv(source);
}

BodiesOrError read_bodies_json(std::string_view text, const ReadProgress& progress) {
  TextSource source(bytes_of(text), text.size(), progress);
  return read_bodies_json(source);
}

}  // namespace harpoon::app
