#pragma once

// What CSV and JSON of bodies have in common: the fields of a body, and the list that they become.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "apps/detect/bodies_file.hpp"

namespace harpoon::app {

inline constexpr std::array<std::string_view, 6> kFields = {"x", "y", "z", "r", "group", "mask"};
inline constexpr std::size_t kNumbers = 4;  ///< of kFields; the others are bits
inline constexpr std::size_t kGroup = 4;
inline constexpr std::size_t kMask = 5;

/// The index in kFields, or nothing.
std::optional<std::size_t> field_of(std::string_view name);

/// One body, field by field.
struct BodyFields {
  std::array<double, kNumbers> numbers = {};
  std::uint32_t group = 1;
  std::uint32_t mask = 0xFFFFFFFF;
};

/// A growing list of bodies.
class BodyList {
 public:
  /// `has_rules`: group or mask were given. False when there are as many as `detect` takes.
  bool append(const BodyFields& body, bool has_rules);
  [[nodiscard]] std::size_t size() const { return bodies_.spheres.size(); }
  FileBodies take() { return std::move(bodies_); }

 private:
  FileBodies bodies_;
  bool is_ruled_ = false;
};

/// What is wrong with a text that does not begin like one of bodies, or nothing.
std::optional<TextError> wrong_beginning(std::string_view look_ahead);

}  // namespace harpoon::app
