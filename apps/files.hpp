#pragma once

// Files: the one place that reads them and the one that writes them. Every call's result is looked
// at. Failures are CommandErrors (environment; data where the content is wrong) that name the file,
// the reason and the remedy.
//
// What is written never takes the place of what is not a regular file: devices, FIFOs and the
// descriptors under /dev/fd are written to. Symbolic links are followed. A regular file, or a new
// one, appears whole or not at all: the content goes to a temporary beside it, which is renamed.
// Mode and owner stay. Where a rename would part the file from its other names (hard links), from
// its owner or from its mount, the whole content is copied into it, after room was made for it.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/output.hpp"

namespace harpoon::app {

/// An open file to read. Not of a folder.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& file);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// The next bytes; 0 at the end.
  std::size_t read(std::span<char> to);
  /// 0 where that cannot be known before the end.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t bytes_ = 0;
};

/// Most bytes of a file that is read whole.
inline constexpr std::uint64_t kMostFileBytes = std::uint64_t{1} << 30;

/// The whole content. Error (data): more than `kMostFileBytes`.
std::string read_file(const std::filesystem::path& file);
/// The same of a text: what is none is an error (data) that says what it is.
std::string read_text_file(const std::filesystem::path& file);

/// A file being written. Without `commit` it stays what it was.
class OutputFile {
 public:
  /// `option` named the file; may be empty.
  explicit OutputFile(const std::filesystem::path& file, std::string_view option = {});
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  [[nodiscard]] Output& out() { return *output_; }
  /// Makes the content the file's.
  void commit();

 private:
  void open();
  void open_temporary();
  int create_temporary();
  void replace();
  void copy_into_place();
  void discard() noexcept;
  [[noreturn]] void fail(int reason);

  std::filesystem::path file_;  ///< as it was named
  std::string remedy_;
  std::filesystem::path target_;  ///< behind all links
  std::filesystem::path temporary_;
  bool is_copied_ = false;  ///< not renamed
  int descriptor_ = -1;
  std::optional<Output> output_;
};

/// Writes the file. `write` is called once.
void write_file(const std::filesystem::path& file, const std::function<void(Output&)>& write);
void write_file(const std::filesystem::path& file, std::string_view content);

/// Makes sure before the work that the file can be written after it, without changing it.
void require_writable_file(const std::filesystem::path& file, std::string_view option);

/// Creates the folder, parents included, and makes sure of these files in it.
void require_writable_folder(const std::filesystem::path& folder, std::string_view option,
                             const std::vector<std::string>& files = {});

/// Appends CSV rows; a new file begins with the header. An existing file with another header is an
/// error, and is left as it is.
void append_csv(const std::filesystem::path& file, std::string_view header, std::string_view rows);

/// A file's name as a message or a list shows it.
std::string shown(const std::filesystem::path& file);

}  // namespace harpoon::app
