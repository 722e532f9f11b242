#include "apps/files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "apps/exit_code.hpp"

namespace harpoon::app {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& path, std::string_view what, std::string_view reason,
                       std::string_view remedy) {
  throw CommandError(ExitCode::environment,
                     fmt::format("Cannot {} {}: {}. {}", what, path.string(), reason, remedy));
}

std::string remedy_for(std::string_view option) {
  return fmt::format("Name a place that can be written with {}.", option);
}

fs::path temporary_beside(const fs::path& file) {
  return file.string() + fmt::format(".{}.tmp", getpid());
}

}  // namespace

void require_writable_folder(const fs::path& folder, std::string_view option) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    fail(folder, "create the folder", error.message(), remedy_for(option));
  }
  if (!fs::is_directory(folder)) {
    fail(folder, "write into", "it is not a folder", remedy_for(option));
  }
  require_writable_file(folder / ".harpoon", option);
}

void require_writable_file(const fs::path& file, std::string_view option) {
  if (fs::is_directory(file)) {
    fail(file, "write", "it is a folder", remedy_for(option));
  }
  const bool existed = fs::exists(file);
  errno = 0;
  const bool opened = std::ofstream(file, std::ios::app).is_open();
  const int reason = errno;
  if (!opened) {
    fail(file, "write", std::strerror(reason), remedy_for(option));
  }
  if (!existed) {
    fs::remove(file);
  }
}

void write_file(const fs::path& file, const std::function<void(std::ostream&)>& write) {
  const fs::path temporary = temporary_beside(file);
  errno = 0;
  std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
  if (stream) {
    try {
      write(stream);
    } catch (...) {
      stream.close();
      fs::remove(temporary);
      throw;
    }
  }
  stream.close();
  if (!stream) {
    const int reason = errno;
    std::error_code ignored;
    fs::remove(temporary, ignored);
    fail(file, "write", std::strerror(reason), "Check the folder and the free space.");
  }
  std::error_code error;
  fs::rename(temporary, file, error);
  if (error) {
    fs::remove(temporary);
    fail(file, "write", error.message(), "Check the folder.");
  }
}

void write_file(const fs::path& file, std::string_view content) {
  write_file(file, [&](std::ostream& stream) { stream << content; });
}

void append_csv(const fs::path& file, std::string_view header, std::string_view rows) {
  std::string content = fs::exists(file) ? read_file(file) : "";
  if (content.empty()) {
    content = fmt::format("{}\n", header);
  } else if (content.substr(0, content.find('\n')) != header) {
    fail(file, "append to", "its first line is not the header of this table",
         "Name another file with --csv.");
  }
  write_file(file, content.append(rows));
}

std::string read_file(const fs::path& file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    fail(file, "read", std::strerror(errno), "Check the name.");
  }
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

}  // namespace harpoon::app
