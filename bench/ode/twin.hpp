#pragma once

// A program that another process runs, in turn with this one: with stock libode there and the
// drop-in here, each side is what its user would start. The two ends are of one machine and one
// build; what they exchange is no format for anybody else.

#include <optional>
#include <variant>
#include <vector>

#include "bench/ode/drop_in_world.hpp"
#include "bench/ode/program.hpp"

namespace harpoon::bench {

/// What make_program makes.
struct ProgramSubject {
  ProgramKind kind = ProgramKind::diamond10;
  std::uint64_t geoms = 0, seed = 0;
};
/// What a DropInWorld is made of.
struct WorldSubject {
  DropInKind kind = DropInKind::packed;
  SpaceKind space = SpaceKind::hash;
  std::uint64_t geoms = 0, seed = 0;
};
using Subject = std::variant<ProgramSubject, WorldSubject>;

struct TimedStep {
  double step_ms = 0;
  Program::Work work;
};

/// Some steps of one side.
struct TwinTurn {
  std::vector<TimedStep> steps;
  std::vector<dReal> state;  ///< after each of them, if these are compared
};

/// A subject of this process.
class SubjectRun {
 public:
  /// The solver takes the order of its constraints from ODE's random numbers; they begin anew. ODE
  /// must be initialised for as long as it lives.
  explicit SubjectRun(const Subject& subject);
  [[nodiscard]] const Program& program() const { return *program_; }
  TwinTurn turn(unsigned steps, bool compares);

 private:
  std::unique_ptr<Program> program_;
};

/// Runs what the other end of the socket asks for, until it is closed. Does not own the socket.
void serve_twins(int socket);

/// A subject of the process that serves at the other end. Nothing once that process has gone.
class Twin {
 public:
  Twin(int socket, const Subject& subject);
  std::optional<TwinTurn> turn(unsigned steps, bool compares);

 private:
  int socket_;
  bool is_there_;
};

}  // namespace harpoon::bench
