#pragma once

// Output files: checked before the work starts, written whole or not at all. Failures are
// CommandErrors (environment) that name the file, the reason and the option to change.

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>

namespace harpoon::app {

/// Creates the folder, parents included, and makes sure that a file can be written in it.
/// `option` is the one that named it.
void require_writable_folder(const std::filesystem::path& folder, std::string_view option);

/// Makes sure that the file can be written (or appended to), without changing it.
void require_writable_file(const std::filesystem::path& file, std::string_view option);

/// Replaces the file, through a temporary beside it: a reader sees the old content or the new.
void write_file(const std::filesystem::path& file, std::string_view content);

/// The same for content too large to hold: `write` is called once with a stream.
void write_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

/// Appends CSV rows; a new file begins with the header. An existing file with another header is an
/// error, and is left as it is.
void append_csv(const std::filesystem::path& file, std::string_view header, std::string_view rows);

/// The whole content.
std::string read_file(const std::filesystem::path& file);

}  // namespace harpoon::app
