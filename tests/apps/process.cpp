#include "apps/process.hpp"

#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

namespace harpoon::app {
namespace {

[[noreturn]] void become(const char* program, const std::vector<std::string>& arguments,
                         const Environment& environment) {
  for (const std::string& entry : environment) {
    const std::size_t equals = entry.find('=');
    if (equals == std::string::npos) {
      unsetenv(entry.c_str());
    } else {
      setenv(entry.substr(0, equals).c_str(), entry.substr(equals + 1).c_str(), 1);
    }
  }
  std::vector<char*> argv = {const_cast<char*>(program)};
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  execv(argv.front(), argv.data());
  _exit(127);
}

int exit_code_of(pid_t pid) {
  int status = 0;
  waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// Appends what is there to read; false at the end. A terminal ends with an error.
bool read_some(int fd, std::string& text) {
  char buffer[4096];
  const ssize_t n = read(fd, buffer, sizeof buffer);
  if (n <= 0) {
    return false;
  }
  text.append(buffer, static_cast<std::size_t>(n));
  return true;
}

Finished run_program(const char* program, const std::vector<std::string>& arguments,
                     const Environment& environment) {
  int out[2];
  int err[2];
  if (pipe(out) != 0 || pipe(err) != 0) {
    return {};
  }
  const pid_t pid = fork();
  if (pid == 0) {
    dup2(out[1], STDOUT_FILENO);
    dup2(err[1], STDERR_FILENO);
    for (const int fd : {out[0], out[1], err[0], err[1]}) {
      close(fd);
    }
    become(program, arguments, environment);
  }
  close(out[1]);
  close(err[1]);
  Finished finished;
  pollfd polled[2] = {{out[0], POLLIN, 0}, {err[0], POLLIN, 0}};
  std::string* texts[2] = {&finished.out, &finished.err};
  while ((polled[0].fd >= 0 || polled[1].fd >= 0) && poll(polled, 2, -1) > 0) {
    for (int i = 0; i < 2; ++i) {
      if (polled[i].revents != 0 && !read_some(polled[i].fd, *texts[i])) {
        close(polled[i].fd);
        polled[i].fd = -1;
      }
    }
  }
  finished.exit_code = exit_code_of(pid);
  return finished;
}

}  // namespace

void become_command(const std::vector<std::string>& arguments) {
  become(HARPOON_COMMAND, arguments, {});
}

Finished run_piped(const std::vector<std::string>& arguments, const Environment& environment) {
  return run_program(HARPOON_COMMAND, arguments, environment);
}

Finished run_script(const std::string& script) {
  return run_program("/bin/sh", {"-c", script}, {std::string("HARPOON=") + HARPOON_COMMAND});
}

Finished run_on_terminal(const std::vector<std::string>& arguments, const Environment& environment,
                         const std::function<void(const std::string&, int)>& on_output) {
  int terminal = -1;
  const pid_t pid = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (pid == 0) {
    become(HARPOON_COMMAND, arguments, environment);
  }
  Finished finished;
  while (read_some(terminal, finished.out)) {
    if (on_output) {
      on_output(finished.out, pid);
    }
  }
  close(terminal);
  finished.exit_code = exit_code_of(pid);
  return finished;
}

}  // namespace harpoon::app
