#include "apps/drop_in.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "apps/exit_code.hpp"
#include "apps/files.hpp"
#include "apps/signals.hpp"

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

void run_with_drop_in(const std::vector<std::string>& command,
                      const std::vector<Variable>& variables) {
  std::string preload = find_drop_in().string();
  if (const char* already = std::getenv(kPreload.data()); already != nullptr && *already != '\0') {
    preload = fmt::format("{}:{}", preload, already);
  }
  set_variable({std::string(kPreload), preload});
  for (const Variable& variable : variables) set_variable(variable);
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  leave_signals_alone();
  ::execvp(arguments[0], arguments.data());
  throw CommandError(ExitCode::environment, fmt::format("{}: {}. Give a program that is there.",
                                                        shown(command[0]), std::strerror(errno)));
}

}  // namespace harpoon::app
