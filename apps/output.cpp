#include "apps/output.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "apps/exit_code.hpp"
#include "apps/printable.hpp"

namespace harpoon::app {
namespace {

bool remark_lost = false;

/// All of `bytes`, however little a call takes; the reason when that fails, else 0.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
      continue;
    }
    // A call that took nothing and gave no reason would be repeated for ever.
    if (written == 0) return EIO;
    if (errno == EAGAIN || errno == EWOULDBLOCK) {
      pollfd ready{descriptor, POLLOUT, 0};
      ::poll(&ready, 1, -1);
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

/// Opens /dev/null as `descriptor` where that is closed. Not inherited.
void open_if_closed(int descriptor, int mode) {
  if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) return;
  const int opened = ::open("/dev/null", mode | O_CLOEXEC);
  if (opened >= 0 && opened != descriptor) {
    ::dup3(opened, descriptor, O_CLOEXEC);
    ::close(opened);
  }
}

}  // namespace

Output::Output(int descriptor, std::string name, std::string remedy)
    : descriptor_(descriptor), name_(std::move(name)), remedy_(std::move(remedy)) {}

void Output::write(std::string_view bytes) {
  buffer_.append(bytes.data(), bytes.data() + bytes.size());
  if (buffer_.size() >= kBufferBytes) flush();
}

void Output::flush() {
  const int reason = write_all(descriptor_, {buffer_.data(), buffer_.size()});
  buffer_.clear();
  if (reason == 0) return;
  throw CommandError(ExitCode::environment,
                     fmt::format("Cannot write {}: {}. {}", name_, std::strerror(reason), remedy_));
}

Output& standard_output() {
  static Output output(STDOUT_FILENO, "standard output",
                       "Look at what it is connected to and at the space there.");
  return output;
}

void remark(std::string_view text) {
  standard_output().flush();
  if (write_all(STDERR_FILENO, text) != 0) remark_lost = true;
}

bool remarks_were_lost() {
  return remark_lost;
}

void open_standard_streams() {
  // Opened the wrong way round, both refuse what is asked of them.
  open_if_closed(STDIN_FILENO, O_WRONLY);
  open_if_closed(STDOUT_FILENO, O_RDONLY);
  open_if_closed(STDERR_FILENO, O_WRONLY);
}

}  // namespace harpoon::app
