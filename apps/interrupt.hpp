#pragma once

// SIGINT and SIGTERM: the first one asks the running measurement to stop, the second one ends the
// process at once.

namespace harpoon::app {

/// Installs the handlers for the life of the process.
void install_interrupt_handlers();

/// Has a signal come?
bool is_interrupted();

/// Throws CommandError(interrupted) when a signal has come.
void throw_if_interrupted();

}  // namespace harpoon::app
