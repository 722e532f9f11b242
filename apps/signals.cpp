#include "apps/signals.hpp"

#include <sched.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <string_view>

namespace harpoon::app {
namespace {

// All that a handler touches. It may run on any thread: what holds signals also holds the lock, and
// its own thread cannot be interrupted meanwhile, so that the handler never waits for itself.
struct Unfinished {
  std::array<char, 4096> path{};
  bool is_used = false;
};
std::array<Unfinished, 8> unfinished;
std::atomic_flag lock = ATOMIC_FLAG_INIT;
std::atomic<bool> file_written = false;
std::atomic<bool> progress_shown = false;

constexpr std::array kEnding = {SIGINT, SIGTERM, SIGHUP};
constexpr std::array kIgnored = {SIGPIPE, SIGXFSZ};
std::array<struct sigaction, kEnding.size() + kIgnored.size()> actions_before;
sigset_t mask_before;

void take_lock() {
  while (lock.test_and_set(std::memory_order_acquire)) ::sched_yield();
}

void say(std::string_view text) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

// Only what POSIX allows in a handler: unlink, write, _exit.
void end(int signal) {
  take_lock();
  for (const Unfinished& file : unfinished) {
    if (file.is_used) ::unlink(file.path.data());
  }
  if (progress_shown) say("\r\x1b[K");
  say(file_written ? "harpoon: error: Interrupted. The files that were written are whole.\n"
                   : "harpoon: error: Interrupted. No file was written.\n");
  ::_exit(128 + signal);
}

sigset_t ending_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : kEnding) sigaddset(&set, signal);
  return set;
}

}  // namespace

void handle_signals() {
  std::size_t k = 0;
  for (const int signal : kEnding) {
    struct sigaction action {};
    action.sa_handler = end;
    action.sa_mask = ending_signals();
    sigaction(signal, &action, &actions_before[k]);
    // Whoever wants a command to outlive its terminal ignores SIGHUP for it (nohup).
    if (signal == SIGHUP && actions_before[k].sa_handler == SIG_IGN) {
      sigaction(signal, &actions_before[k], nullptr);
    }
    ++k;
  }
  for (const int signal : kIgnored) {
    struct sigaction action {};
    action.sa_handler = SIG_IGN;
    sigaction(signal, &action, &actions_before[k++]);
  }
  const sigset_t set = ending_signals();
  pthread_sigmask(SIG_UNBLOCK, &set, &mask_before);
}

void leave_signals_alone() {
  std::size_t k = 0;
  for (const int signal : kEnding) sigaction(signal, &actions_before[k++], nullptr);
  for (const int signal : kIgnored) sigaction(signal, &actions_before[k++], nullptr);
  pthread_sigmask(SIG_SETMASK, &mask_before, nullptr);
}

SignalsHeld::SignalsHeld() {
  const sigset_t set = ending_signals();
  pthread_sigmask(SIG_BLOCK, &set, &before_);
  take_lock();
}

SignalsHeld::~SignalsHeld() {
  lock.clear(std::memory_order_release);
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

bool add_unfinished(const std::string& path) {
  for (Unfinished& file : unfinished) {
    if (file.is_used) continue;
    if (path.size() >= file.path.size()) return false;
    std::memcpy(file.path.data(), path.c_str(), path.size() + 1);
    file.is_used = true;
    return true;
  }
  return false;
}

void forget_unfinished(const std::string& path) {
  for (Unfinished& file : unfinished) {
    if (file.is_used && path == file.path.data()) file.is_used = false;
  }
}

void note_file_written() {
  file_written = true;
}

void note_progress(bool is_shown) {
  progress_shown = is_shown;
}

}  // namespace harpoon::app
