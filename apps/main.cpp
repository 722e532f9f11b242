// The `harpoon` command. Everything is in the parts beside it, so that tests can reach them.

#include "apps/command.hpp"

int main(int argc, char** argv) {
  return harpoon::app::run_command_line(argc, argv);
}
