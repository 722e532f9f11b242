#pragma once

// Reads a user's bodies from CSV or JSON text. Malformed text is an error that names line and
// column; nothing is guessed.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "harpoon/scene.hpp"

namespace harpoon::app {

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
/// Called now and then with the part that has been read, 0 to 1.
using ReadProgress = std::function<void(double)>;

/// CSV: a header that names x, y, z, r and perhaps group, mask, in any order, then a body a line.
/// Blank lines and lines beginning with # are skipped.
BodiesOrError read_bodies_csv(std::string_view text, const ReadProgress& progress = {});

/// JSON: an array of objects {"x": .., "y": .., "z": .., "r": .., "group": .., "mask": ..}, or an
/// object with such an array as "bodies".
BodiesOrError read_bodies_json(std::string_view text, const ReadProgress& progress = {});

}  // namespace harpoon::app
