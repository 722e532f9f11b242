// Preloaded into the command: counts its calls of one kind that concern the test's folder or
// standard input and output, and lets one of them fail, or all of them do little. Uses the kernel
// directly, so that nothing of its own is counted.

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace {

std::string_view variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string_view() : value;
}

bool concerns(std::string_view path) {
  const std::string_view folder = variable("FAILING_FOLDER");
  return !folder.empty() && path.starts_with(folder);
}

bool concerns(int descriptor) {
  if (descriptor == STDIN_FILENO || descriptor == STDOUT_FILENO) return true;
  char name[32] = "/proc/self/fd/";
  std::size_t at = std::strlen(name);
  if (descriptor < 0 || descriptor > 99) return false;
  if (descriptor > 9) name[at++] = static_cast<char>('0' + descriptor / 10);
  name[at++] = static_cast<char>('0' + descriptor % 10);
  name[at] = '\0';
  std::array<char, 4096> path{};
  const long length = syscall(SYS_readlink, name, path.data(), path.size());
  return length > 0 && concerns(std::string_view(path.data(), static_cast<std::size_t>(length)));
}

/// Is this the call that is to fail? Says so in a file, and sets errno.
template <class Where>
bool fails(std::string_view kind, const Where& where) {
  static long seen = 0;
  if (variable("FAILING_CALL") != kind || !concerns(where)) return false;
  if (seen++ != std::atol(std::getenv("FAILING_NUMBER"))) return false;
  const long reached =
      syscall(SYS_openat, AT_FDCWD, std::getenv("FAILING_REACHED"), O_WRONLY | O_CREAT, 0600);
  if (reached >= 0) syscall(SYS_close, static_cast<int>(reached));
  errno = std::atoi(std::getenv("FAILING_ERRNO"));
  return true;
}

/// So much of a transfer at once.
std::size_t share(std::string_view kind, int descriptor, std::size_t bytes) {
  const bool little = variable("FAILING_CALL") == kind && bytes > 1 && concerns(descriptor);
  return little ? 1 + bytes / 3 : bytes;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  mode_t mode = 0;
  if ((flags & O_CREAT) != 0) {
    std::va_list arguments;
    va_start(arguments, flags);
    mode = va_arg(arguments, mode_t);
    va_end(arguments);
  }
  if (fails("open", std::string_view(path))) return -1;
  return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

ssize_t read(int descriptor, void* to, size_t bytes) {
  if (fails("read", descriptor)) return -1;
  return syscall(SYS_read, descriptor, to, share("short read", descriptor, bytes));
}

ssize_t write(int descriptor, const void* from, size_t bytes) {
  if (fails("write", descriptor)) return -1;
  return syscall(SYS_write, descriptor, from, share("short write", descriptor, bytes));
}

ssize_t pread(int descriptor, void* to, size_t bytes, off_t at) {
  if (fails("read", descriptor)) return -1;
  return syscall(SYS_pread64, descriptor, to, share("short read", descriptor, bytes), at);
}

ssize_t pwrite(int descriptor, const void* from, size_t bytes, off_t at) {
  if (fails("write", descriptor)) return -1;
  return (syscall(SYS_pwrite64, descriptor, from, share("short write", descriptor, bytes), at));
}

int close(int descriptor) {
  const bool failed = fails("close", descriptor);
  const int reason = errno;
  const int result = static_cast<int>(syscall(SYS_close, descriptor));
  if (failed) errno = reason;
  return failed ? -1 : result;
}

int fsync(int descriptor) {
  if (fails("fsync", descriptor)) return -1;
  return static_cast<int>(syscall(SYS_fsync, descriptor));
}

int posix_fallocate(int descriptor, off_t at, off_t bytes) {
  if (fails("fallocate", descriptor)) return errno;
  return syscall(SYS_fallocate, descriptor, 0, at, bytes) == 0 ? 0 : errno;
}

int rename(const char* from, const char* to) {
  if (fails("rename", std::string_view(to))) return -1;
  return static_cast<int>(syscall(SYS_rename, from, to));
}

int mkdir(const char* path, mode_t mode) {
  if (fails("mkdir", std::string_view(path))) return -1;
  return static_cast<int>(syscall(SYS_mkdir, path, mode));
}

}  // extern "C"
