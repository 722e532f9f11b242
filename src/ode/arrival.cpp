#include "ode/arrival.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

#include "harpoon/export.hpp"
#include "ode/engine_library.hpp"
#include "ode/log.hpp"

namespace harpoon::ode {
namespace {

/// Reads a number and what follows it, if anything.
unsigned long long next_number(const char*& text) {
  char* end = nullptr;
  const unsigned long long number = std::strtoull(text, &end, 10);
  text = end;
  return number;
}

void append(char*& at, const char* text) {
  while (*text != '\0') *at++ = *text++;
}
void append(char*& at, unsigned long long number) {
  char digits[24];
  char* first = digits + sizeof digits;
  do *--first = static_cast<char>('0' + number % 10);
  while ((number /= 10) != 0);
  while (first != digits + sizeof digits) *at++ = *first++;
}

/// Sets a byte of the file that `harpoon run` waits for, if it does.
void tell(off_t place) {
  const char* text = std::getenv(kArrivalVariable);
  if (text == nullptr) return;
  const unsigned long long process = next_number(text), file = next_number(text),
                           device = next_number(text), inode = next_number(text);
  char path[80];
  char* end = path;
  append(end, "/proc/");
  append(end, process);
  append(end, "/fd/");
  append(end, file);
  *end = '\0';
  const int opened = ::open(path, O_WRONLY | O_CLOEXEC);
  if (opened < 0) return;
  struct stat status {};
  // The number may be another process's by now.
  if (::fstat(opened, &status) == 0 && status.st_dev == device && status.st_ino == inode) {
    [[maybe_unused]] const ssize_t written = ::pwrite(opened, "1", 1, place);
  }
  ::close(opened);
}

bool is_on(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr && std::strcmp(value, "1") == 0;
}

/// The process that this library was loaded in, not one that was forked from it.
pid_t first_process = 0;
[[gnu::constructor]] void note_process() {
  first_process = ::getpid();
}

/// At the end of the process, when somebody will miss what did not come. Where `harpoon run` waits
/// it says so itself, once for all processes.
[[gnu::destructor]] void say_that_none_arrived() {
  if (has_arrived.load() || ::getpid() != first_process) return;
  if (std::getenv(kArrivalVariable) != nullptr) return;
  if (!is_on("HARPOON_STATS") && !is_on("HARPOON_VERIFY")) return;
  write_log_line(LogLevel::info, {"no call of ODE arrived in ", program_invocation_short_name,
                                  ": nothing was served or compared (docs/ode.md says why)"});
}

}  // namespace

void tell_arrival() {
  has_arrived.store(true, std::memory_order_relaxed);
  tell(0);
}

void note_service() {
  tell(1);
}

}  // namespace harpoon::ode

extern "C" {

/// A program that ends in this way runs nothing that waits for its end.
HARPOON_API void _exit(int status) {
  harpoon::ode::report_all();
  harpoon::ode::say_that_none_arrived();
  for (;;) ::syscall(SYS_exit_group, status);
}

HARPOON_API void _Exit(int status) {
  ::_exit(status);
}

}  // extern "C"
