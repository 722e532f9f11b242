#pragma once

// Reads a user's bodies from CSV or JSON text. Malformed text is an error that names line, column
// and what it is; nothing is guessed. However large the text, what is in memory are the bodies, at
// most three times while their arrays grow, and one buffer (text_source.hpp).

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "apps/detect/text_source.hpp"
#include "harpoon/scene.hpp"

namespace harpoon::app {

/// Most bytes of a CSV field, or of a JSON name, number or text.
inline constexpr std::size_t kMostTokenBytes = 1024;
/// How deep JSON goes: an object with an array of bodies.
inline constexpr std::size_t kMostJsonDepth = 3;

struct FileBodies {
  std::vector<SphereF64> spheres;
  std::vector<std::uint32_t> group, mask;  ///< both empty, or one of each for every body
};

/// Where and why a text cannot be read. Line and column count from 1, columns in bytes.
struct TextError {
  std::size_t line = 1;
  std::size_t column = 1;
  std::string reason;
};

using BodiesOrError = std::variant<FileBodies, TextError>;

/// CSV: a header that names x, y, z, r and perhaps group, mask, in any order, then a body a line.
/// Blank lines and lines beginning with # are skipped.
BodiesOrError read_bodies_csv(TextSource& source);

/// JSON: an array of objects {"x": .., "y": .., "z": .., "r": .., "group": .., "mask": ..}, or an
/// object with such an array as "bodies".
BodiesOrError read_bodies_json(TextSource& source);

/// The same of a text in memory.
BodiesOrError read_bodies_csv(std::string_view text, const ReadProgress& progress = {});
BodiesOrError read_bodies_json(std::string_view text, const ReadProgress& progress = {});

}  // namespace harpoon::app
