#pragma once

// Complete programs on ODE, as its users write them: collision, contact joints and the solver, or a
// planner that only asks what collides. They know nothing of Harpoon, depend on their seed only,
// and measure their collision and nothing else.

#include <ode/ode.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace harpoon::bench {

enum class ProgramKind : std::uint8_t {
  diamond10,  ///< the paper's diamond, hMax 10: 1,561 spheres
  diamond30,  ///< hMax 30: 37,881 spheres
  pile,       ///< spheres, boxes and capsules dropped into a pen
  sleeping,   ///< stacks of boxes, all asleep but for those that eight balls run into
  planner,    ///< an arm of 42 geoms searches a way between plates; no solver
  clutter,    ///< the same, each plate given as 25 boxes as a scanner sees it
};
inline constexpr std::size_t kProgramKinds = 6;
std::optional<ProgramKind> parse_program_kind(std::string_view name);
std::string_view to_string(ProgramKind kind);

/// Whether its number of geoms can be chosen.
bool has_size(ProgramKind kind);

class Program {
 public:
  Program() = default;
  virtual ~Program() = default;
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  struct Work {
    double collision_ms = 0;  ///< in dSpaceCollide with dCollide in the callback
    std::uint64_t pairs = 0, contacts = 0;
  };
  /// One step of the program.
  virtual Work step() = 0;
  /// The same for a program that append_state is asked of next. One that would have to do more for
  /// this than it does anyway does so here, and its times are then no measurement.
  virtual Work compared_step() { return step(); }
  /// Steps before the program is in the state that it is measured in.
  [[nodiscard]] virtual unsigned settling_steps() const { return 0; }
  [[nodiscard]] virtual std::size_t geoms() const = 0;
  /// Appends all that the last step changed or found out.
  virtual void append_state(std::vector<dReal>& state) const = 0;
};

/// `geoms` is the number of moved geoms or, for planner and clutter, of obstacles; 0 means the
/// program's own. ODE must be initialised for as long as the program lives.
std::unique_ptr<Program> make_program(ProgramKind kind, std::size_t geoms, std::uint64_t seed);

}  // namespace harpoon::bench
