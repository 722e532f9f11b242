#include "apps/files.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>

#include "apps/exit_code.hpp"
#include "apps/file_kind.hpp"
#include "apps/printable.hpp"
#include "apps/signals.hpp"

namespace harpoon::app {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kChunkBytes = std::size_t{1} << 16;

[[noreturn]] void refuse(const fs::path& path, std::string_view what, std::string_view reason,
                         std::string_view remedy) {
  throw CommandError(ExitCode::environment,
                     fmt::format("Cannot {} {}: {}. {}", what, shown(path), reason, remedy));
}

std::string remedy_for(std::string_view option) {
  return option.empty() ? "Check the folder and the free space."
                        : fmt::format("Name a place that can be written with {}.", option);
}

/// The open descriptor that a path such as /dev/fd/3 names, or -1.
int named_descriptor(const fs::path& path) {
  std::error_code error;
  const fs::path folder = fs::canonical(path.parent_path(), error);
  if (error || folder != fs::canonical("/proc/self/fd", error)) return -1;
  const std::string name = path.filename().string();
  int number = -1;
  const auto [end, wrong] = std::from_chars(name.data(), name.data() + name.size(), number);
  return wrong == std::errc() && end == name.data() + name.size() ? number : -1;
}

/// What a name leads to: a descriptor of this process, or a path that is no symbolic link.
struct Target {
  fs::path path;
  int descriptor = -1;
};

Target follow(fs::path path) {
  constexpr int kMostLinks = 40;  // as many as Linux follows
  for (int k = 0; k < kMostLinks; ++k) {
    if (const int descriptor = named_descriptor(path); descriptor >= 0) return {path, descriptor};
    std::error_code error;
    const fs::path next = fs::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / next;
  }
  return {path};
}

bool is_special(const struct stat& status) {
  return !S_ISREG(status.st_mode);
}

/// Waits until a call that would have had to wait can be repeated.
void wait_for(int descriptor, short what) {
  pollfd ready{descriptor, what, 0};
  ::poll(&ready, 1, -1);
}

}  // namespace

// ---- Reading -----------------------------------------------------------------------------------

InputFile::InputFile(const fs::path& file) : file_(file) {
  constexpr std::string_view kRemedy = "Check the name.";
  descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY);
  if (descriptor_ < 0) refuse(file, "read", std::strerror(errno), kRemedy);
  struct stat status {};
  const int reason = ::fstat(descriptor_, &status) == 0 ? 0 : errno;
  const bool is_folder = reason == 0 && S_ISDIR(status.st_mode);
  if (reason != 0 || is_folder) {
    ::close(descriptor_);
    refuse(file, "read", is_folder ? "it is a folder" : std::strerror(reason), kRemedy);
  }
  if (S_ISREG(status.st_mode)) bytes_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() {
  ::close(descriptor_);
}

std::size_t InputFile::read(std::span<char> to) {
  while (true) {
    const ssize_t got = ::read(descriptor_, to.data(), to.size());
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno == EAGAIN || errno == EWOULDBLOCK) {
      wait_for(descriptor_, POLLIN);
    } else if (errno != EINTR) {
      refuse(file_, "read", std::strerror(errno), "What was read is not all of it.");
    }
  }
}

namespace {

std::string read_all(const fs::path& file, bool is_text) {
  InputFile input(file);
  std::string content;
  while (true) {
    const std::size_t had = content.size();
    content.resize(had + kChunkBytes);
    const std::size_t got = input.read({content.data() + had, kChunkBytes});
    content.resize(had + got);
    if (got == 0) return content;
    if (content.size() > kMostFileBytes) {
      throw CommandError(ExitCode::data,
                         fmt::format("{} has more than {} bytes.", shown(file), kMostFileBytes));
    }
    const std::string_view news = std::string_view(content).substr(had);
    if (is_text && (had == 0 || news.find('\0') != std::string_view::npos)) {
      const std::string kind = other_than_text(news);
      if (!kind.empty()) {
        throw CommandError(ExitCode::data, fmt::format("{} is {}.", shown(file), kind));
      }
    }
  }
}

}  // namespace

std::string read_file(const fs::path& file) {
  return read_all(file, false);
}

std::string read_text_file(const fs::path& file) {
  return read_all(file, true);
}

// ---- Writing -----------------------------------------------------------------------------------

OutputFile::OutputFile(const fs::path& file, std::string_view option)
    : file_(file), remedy_(remedy_for(option)) {
  open();
  output_.emplace(descriptor_, shown(file_), remedy_);
}

OutputFile::~OutputFile() {
  discard();
}

void OutputFile::open() {
  const Target target = follow(file_);
  target_ = target.path;
  if (target.descriptor >= 0) {
    standard_output().flush();  // which may go to the same place
    descriptor_ = ::fcntl(target.descriptor, F_DUPFD_CLOEXEC, 3);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  struct stat status {};
  if (::stat(target_.c_str(), &status) == 0 && is_special(status)) {
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  open_temporary();
}

/// The reason when it cannot be created, else 0.
int OutputFile::create_temporary() {
  constexpr int kMostTries = 100;
  const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
  for (int k = 0;; ++k) {
    const SignalsHeld held;
    const fs::path name = folder / fmt::format(".harpoon-{}-{}.tmp", ::getpid(), k);
    if (!add_unfinished(name.string())) return ENAMETOOLONG;
    descriptor_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    const int reason = errno;
    if (descriptor_ >= 0) {
      temporary_ = name;
      return 0;
    }
    forget_unfinished(name.string());
    if (reason != EEXIST || k == kMostTries) return reason;
  }
}

void OutputFile::open_temporary() {
  struct stat old {};
  const bool exists = ::stat(target_.c_str(), &old) == 0;
  if (!exists && errno != ENOENT) fail(errno);
  if (exists && ::faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) != 0) fail(errno);
  if (const int reason = create_temporary(); reason != 0) fail(reason);
  if (!exists) return;
  struct stat mine {};
  if (::fstat(descriptor_, &mine) != 0) fail(errno);
  const bool same_owner = mine.st_uid == old.st_uid && mine.st_gid == old.st_gid;
  const bool kept_owner = same_owner || ::fchown(descriptor_, old.st_uid, old.st_gid) == 0;
  const bool kept_mode = ::fchmod(descriptor_, old.st_mode & 07777) == 0;
  is_copied_ = old.st_nlink > 1 || !kept_owner || !kept_mode;
}

void OutputFile::commit() {
  output_->flush();
  if (temporary_.empty()) {
    if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
    note_file_written();
    return;
  }
  // Some file systems say only here that there was no room.
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOSYS) fail(errno);
  if (!is_copied_) replace();
  if (is_copied_) copy_into_place();
  note_file_written();
  discard();
}

void OutputFile::replace() {
  int reason = 0;
  {
    const SignalsHeld held;
    if (::rename(temporary_.c_str(), target_.c_str()) == 0) {
      forget_unfinished(temporary_.string());
      temporary_.clear();
      return;
    }
    reason = errno;
  }
  // A file that is mounted by itself cannot be renamed away.
  if (reason != EBUSY) fail(reason);
  is_copied_ = true;
}

namespace {

/// Copies `from` over `to`, which is as long as it or longer. The reason when that fails, else 0.
int copy_bytes(int from, int to, off_t bytes) {
  std::array<char, kChunkBytes> chunk;
  for (off_t at = 0; at < bytes;) {
    const ssize_t got = ::pread(from, chunk.data(), chunk.size(), at);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return got == 0 ? EIO : errno;
    for (ssize_t done = 0; done < got;) {
      const ssize_t put =
          ::pwrite(to, chunk.data() + done, static_cast<std::size_t>(got - done), at + done);
      if (put < 0 && errno == EINTR) continue;
      if (put <= 0) return put == 0 ? EIO : errno;
      done += put;
    }
    at += got;
  }
  return 0;
}

}  // namespace

// Until there is room for all of it the file is as it was. If the copy fails after that, which only
// a broken disk explains, the temporary is all there is, and stays.
void OutputFile::copy_into_place() {
  const int to = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
  if (to < 0) fail(errno);
  struct stat content {
  }, old{};
  int reason = ::fstat(descriptor_, &content) == 0 && ::fstat(to, &old) == 0 ? 0 : errno;
  bool is_begun = false;
  {
    const SignalsHeld held;
    if (reason == 0 && content.st_size > old.st_size) {
      reason = ::posix_fallocate(to, 0, content.st_size);
      if (reason != 0 && ::ftruncate(to, old.st_size) != 0) reason = errno;
    }
    if (reason == 0) {
      is_begun = true;
      reason = copy_bytes(descriptor_, to, content.st_size);
    }
    if (reason == 0 && ::ftruncate(to, content.st_size) != 0) reason = errno;
    if (reason == 0 && ::fsync(to) != 0 && errno != EINVAL && errno != ENOSYS) reason = errno;
    if (::close(to) != 0 && reason == 0) reason = errno;
    if (reason != 0 && is_begun) forget_unfinished(temporary_.string());
  }
  if (reason == 0) return;
  if (is_begun) {
    remedy_ = fmt::format("Its content is spoilt; what it should be is in {}.", shown(temporary_));
    temporary_.clear();
  }
  fail(reason);
}

void OutputFile::discard() noexcept {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (temporary_.empty()) return;
  const SignalsHeld held;
  ::unlink(temporary_.c_str());
  forget_unfinished(temporary_.string());
  temporary_.clear();
}

void OutputFile::fail(int reason) {
  discard();
  refuse(file_, "write", std::strerror(reason), remedy_);
}

void write_file(const fs::path& file, const std::function<void(Output&)>& write) {
  OutputFile output(file);
  write(output.out());
  output.commit();
}

void write_file(const fs::path& file, std::string_view content) {
  write_file(file, [&](Output& out) { out.write(content); });
}

void require_writable_file(const fs::path& file, std::string_view option) {
  const Target target = follow(file);
  struct stat status {};
  const bool exists = ::stat(target.path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) {
    refuse(file, "write", "it is a folder", remedy_for(option));
  }
  if (target.descriptor >= 0) {
    const int flags = ::fcntl(target.descriptor, F_GETFL);
    if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY) {
      refuse(file, "write", std::strerror(EBADF), remedy_for(option));
    }
  } else if (exists && is_special(status)) {
    // To open a FIFO would wait for its reader, and to close it would end that one's file.
    if (::faccessat(AT_FDCWD, target.path.c_str(), W_OK, AT_EACCESS) != 0) {
      refuse(file, "write", std::strerror(errno), remedy_for(option));
    }
  } else {
    const OutputFile tried(file, option);
  }
}

void require_writable_folder(const fs::path& folder, std::string_view option,
                             const std::vector<std::string>& files) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse(folder, "create the folder", error.message(), remedy_for(option));
  if (!fs::is_directory(folder, error)) {
    refuse(folder, "write into", "it is not a folder", remedy_for(option));
  }
  require_writable_file(folder / ".harpoon", option);
  for (const std::string& file : files) require_writable_file(folder / file, option);
}

void append_csv(const fs::path& file, std::string_view header, std::string_view rows) {
  const Target target = follow(file);
  std::error_code error;
  const bool has_content = target.descriptor < 0 && fs::is_regular_file(target.path, error);
  std::string content = has_content ? read_text_file(target.path) : "";
  if (content.empty()) {
    content = fmt::format("{}\n", header);
  } else if (content.substr(0, content.find('\n')) != header) {
    refuse(file, "append to", "its first line is not the header of this table",
           "Name another file with --csv.");
  }
  write_file(file, content.append(rows));
}

std::string shown(const fs::path& file) {
  constexpr std::size_t kMostOfAName = 300;
  return printable(file.native(), kMostOfAName);
}

}  // namespace harpoon::app
