#pragma once

// What ends the command from outside: one SIGINT, SIGTERM or SIGHUP ends it at once with 128 and
// the signal's number, and removes the files that are not finished. Nothing that computes has to
// ask. Knows nothing of what is in the files.

#include <csignal>
#include <string>

namespace harpoon::app {

/// Installs the handlers, also where the parent had them ignored; SIGPIPE and SIGXFSZ become errors
/// of the write that meets them.
void handle_signals();

/// Gives every signal the action that it had before: for a process that becomes or serves another
/// program. Only after handle_signals.
void leave_signals_alone();

/// While one lives, no signal ends the process; what came is delivered afterwards. For moments in
/// which a file is neither the old nor the new one. One thread at a time may have one.
class SignalsHeld {
 public:
  SignalsHeld();
  ~SignalsHeld();
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  sigset_t before_{};
};

/// A file to be removed if a signal ends the process. Call both with signals held. False when there
/// are too many such files, or the name is too long.
bool add_unfinished(const std::string& path);
void forget_unfinished(const std::string& path);

/// What the last words may say: that a file was written, and that a progress bar is to be wiped.
void note_file_written();
void note_progress(bool is_shown);

}  // namespace harpoon::app
