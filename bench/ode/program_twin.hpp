#pragma once

// A program that another process runs, step by step as this one asks: with stock libode there and
// the drop-in here, each side is what its user would start. The two ends are of one machine and one
// build; what they exchange is no format for anybody else.

#include <optional>
#include <vector>

#include "bench/ode/program.hpp"

namespace harpoon::bench {

struct ProgramStep {
  double step_ms = 0;
  Program::Work work;
  std::vector<dReal> state;
};

/// A program of this process.
class ProgramRun {
 public:
  /// As make_program. The solver takes the order of its constraints from ODE's random numbers; they
  /// begin anew.
  ProgramRun(ProgramKind kind, std::size_t geoms, std::uint64_t seed);
  [[nodiscard]] const Program& program() const { return *program_; }
  /// Runs a step and times it.
  ProgramStep step();

 private:
  std::unique_ptr<Program> program_;
};

/// Runs what the other end of the socket asks for, until it is closed. Does not own the socket.
void serve_programs(int socket);

/// A program of the process that serves at the other end. Nothing once that process has gone.
class ProgramTwin {
 public:
  ProgramTwin(int socket, ProgramKind kind, std::size_t geoms, std::uint64_t seed);
  std::optional<ProgramStep> step();

 private:
  int socket_;
  bool is_there_;
};

}  // namespace harpoon::bench
