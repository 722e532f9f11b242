#include "apps/drop_in.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "apps/exit_code.hpp"
#include "apps/files.hpp"
#include "apps/output.hpp"
#include "apps/signals.hpp"
#include "ode/arrival.hpp"

namespace harpoon::app {
namespace {

constexpr std::string_view kPreload = "LD_PRELOAD";

void set_variable(const Variable& variable) {
  ::setenv(variable.name.c_str(), variable.value.c_str(), 1);
}

}  // namespace

std::filesystem::path find_drop_in() {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path here = self.parent_path();
  for (const char* folder : {"../lib", HARPOON_INSTALLED_LIBRARIES}) {
    std::filesystem::path file = (here / folder / "libharpoon_ode.so").lexically_normal();
    if (std::filesystem::exists(file, error)) return file;
  }
  throw CommandError(ExitCode::environment,
                     fmt::format("There is no libharpoon_ode.so beside {}. Build or install the "
                                 "whole of Harpoon.",
                                 shown(self)));
}

namespace {

/// Sets all variables, with the library in front of what is preloaded already.
void set_environment(const std::vector<Variable>& variables) {
  std::string preload = find_drop_in().string();
  // The dynamic linker takes these for the end of a name and would go on without a word.
  if (preload.find_first_of(": \t\n") != std::string::npos) {
    throw CommandError(ExitCode::environment,
                       fmt::format("{} cannot be preloaded: there is a colon or a space in its "
                                   "path. Install Harpoon elsewhere.",
                                   shown(preload)));
  }
  if (const char* already = std::getenv(kPreload.data()); already != nullptr && *already != '\0') {
    preload = fmt::format("{}:{}", preload, already);
  }
  set_variable({std::string(kPreload), preload});
  for (const Variable& variable : variables) set_variable(variable);
}

/// Becomes the command; returns when that fails, with the reason in errno.
void become(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  leave_signals_alone();
  ::execvp(arguments[0], arguments.data());
}

[[noreturn]] void refuse(const std::vector<std::string>& command, int error) {
  throw CommandError(ExitCode::environment, fmt::format("{}: {}. Give a program that is there.",
                                                        shown(command[0]), std::strerror(error)));
}

[[noreturn]] void refuse_process() {
  throw CommandError(ExitCode::environment, fmt::format("There is no second process: {}. End some "
                                                        "others.",
                                                        std::strerror(errno)));
}

/// A file without a name in which processes note that calls of ODE arrived and were served.
class Arrivals {
 public:
  Arrivals() : file_(::memfd_create("harpoon-arrivals", MFD_CLOEXEC)) {
    struct stat status {};
    if (file_ < 0 || ::fstat(file_, &status) != 0) refuse_process();
    set_variable({ode::kArrivalVariable,
                  fmt::format("{} {} {} {}", ::getpid(), file_, status.st_dev, status.st_ino)});
  }
  [[nodiscard]] bool arrived() const { return noted(0); }
  [[nodiscard]] bool served() const { return noted(1); }

 private:
  [[nodiscard]] bool noted(off_t place) const {
    char byte = 0;
    return ::pread(file_, &byte, 1, place) == 1 && byte == '1';
  }
  int file_;
};

/// Signals that are for the program, and the news of its end.
sigset_t watched_signals() {
  sigset_t signals;
  ::sigemptyset(&signals);
  for (const int number :
       {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2, SIGTSTP, SIGCONT, SIGCHLD}) {
    ::sigaddset(&signals, number);
  }
  return signals;
}

/// Starts the command, whose signals are what they were. Throws CommandError.
pid_t start(const std::vector<std::string>& command, const sigset_t& usual_signals) {
  int failure[2];
  const pid_t child = ::pipe2(failure, O_CLOEXEC) == 0 ? ::fork() : -1;
  if (child < 0) refuse_process();
  if (child == 0) {
    ::sigprocmask(SIG_SETMASK, &usual_signals, nullptr);
    become(command);
    const int error = errno;
    [[maybe_unused]] const ssize_t written = ::write(failure[1], &error, sizeof error);
    ::_exit(static_cast<int>(ExitCode::environment));
  }
  ::close(failure[1]);
  int error = 0;
  const bool failed = ::read(failure[0], &error, sizeof error) == sizeof error;
  ::close(failure[0]);
  if (!failed) return child;
  ::waitpid(child, nullptr, 0);
  refuse(command, error);
}

/// Waits for the end of the child, whose status it returns. What a terminal sends both receive;
/// what others send to this process is passed on. Stops when the child is stopped.
int wait_for(pid_t child, const sigset_t& signals) {
  for (;;) {
    siginfo_t news{};
    if (::sigwaitinfo(&signals, &news) < 0) continue;
    if (news.si_signo != SIGCHLD) {
      if (news.si_code <= 0 || news.si_signo == SIGCONT) ::kill(child, news.si_signo);
      continue;
    }
    int status = 0;
    if (::waitpid(child, &status, WNOHANG | WUNTRACED) != child) continue;
    if (!WIFSTOPPED(status)) return status;
    ::raise(SIGSTOP);
  }
}

/// Ends as the program ended.
[[noreturn]] void end_as(int status) {
  if (WIFSIGNALED(status)) {
    const rlimit no_core{0, 0};  // there is one already
    ::setrlimit(RLIMIT_CORE, &no_core);
    ::signal(WTERMSIG(status), SIG_DFL);
    sigset_t all;
    ::sigfillset(&all);
    ::sigprocmask(SIG_UNBLOCK, &all, nullptr);
    ::raise(WTERMSIG(status));
    std::exit(128 + WTERMSIG(status));
  }
  std::exit(WEXITSTATUS(status));
}

/// What is to be said of arrivals; nothing when a call was served.
std::string absence(const Arrivals& arrivals) {
  if (arrivals.served()) return {};
  return arrivals.arrived()
             ? "calls of ODE arrived, but Harpoon could not serve them: see above"
             : "no call of ODE arrived at Harpoon: nothing was served or compared. The program "
               "uses "
               "no ODE, is linked to it statically, or loaded it past Harpoon (RTLD_DEEPBIND, "
               "dlsym); docs/ode.md";
}

}  // namespace

void run_and_watch(const std::vector<std::string>& command, const std::vector<Variable>& variables,
                   Watched watched) {
  set_environment(variables);
  const Arrivals arrivals;
  ::signal(SIGCHLD, SIG_DFL);
  const sigset_t signals = watched_signals();
  sigset_t usual;
  ::sigprocmask(SIG_BLOCK, &signals, &usual);
  const pid_t child = start(command, usual);
  const int status = wait_for(child, signals);
  const std::string absent = absence(arrivals);
  if (!absent.empty()) {
    if (watched.require && WIFEXITED(status)) {
      throw CommandError(ExitCode::not_served,
                         fmt::format("{} (the program itself ended with exit code {})", absent,
                                     WEXITSTATUS(status)));
    }
    note("harpoon: {}\n", absent);
  }
  end_as(status);
}

void run_with_drop_in(const std::vector<std::string>& command,
                      const std::vector<Variable>& variables) {
  set_environment(variables);
  become(command);
  refuse(command, errno);
}

}  // namespace harpoon::app
