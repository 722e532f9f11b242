// A library that must not be loaded: it says so when it is.

#include <unistd.h>

namespace {

[[gnu::constructor]] void say_so() {
  constexpr char kText[] = "foreign code was run\n";
  [[maybe_unused]] const ssize_t written = write(STDOUT_FILENO, kText, sizeof kText - 1);
}

}  // namespace
