#include "apps/interrupt.hpp"

#include <csignal>

#include "apps/exit_code.hpp"

namespace harpoon::app {
namespace {

// The only thing a signal handler may touch.
volatile std::sig_atomic_t interrupted = 0;

void remember(int) {
  interrupted = 1;
}

}  // namespace

void install_interrupt_handlers() {
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool is_interrupted() {
  return interrupted != 0;
}

void throw_if_interrupted() {
  if (is_interrupted()) {
    throw CommandError(ExitCode::interrupted, "Interrupted. No file was written.");
  }
}

}  // namespace harpoon::app
