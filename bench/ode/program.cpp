#include "bench/ode/program.hpp"

#include <array>
#include <utility>

#include "bench/ode/diamond_program.hpp"
#include "bench/ode/pile_program.hpp"
#include "bench/ode/planner_program.hpp"
#include "bench/ode/sleeping_program.hpp"

namespace harpoon::bench {
namespace {

constexpr std::array<std::pair<std::string_view, ProgramKind>, kProgramKinds> kKinds = {{
    {"diamond10", ProgramKind::diamond10},
    {"diamond30", ProgramKind::diamond30},
    {"pile", ProgramKind::pile},
    {"sleeping", ProgramKind::sleeping},
    {"planner", ProgramKind::planner},
    {"clutter", ProgramKind::clutter},
}};
constexpr std::size_t kPileBodies = 3000;
constexpr std::size_t kSleepingBodies = 10000;
constexpr std::size_t kPlates = 40;

}  // namespace

std::optional<ProgramKind> parse_program_kind(std::string_view name) {
  for (const auto& [known, kind] : kKinds) {
    if (known == name) return kind;
  }
  return std::nullopt;
}

std::string_view to_string(ProgramKind kind) {
  return kKinds[static_cast<std::size_t>(kind)].first;
}

bool has_size(ProgramKind kind) {
  return kind != ProgramKind::diamond10 && kind != ProgramKind::diamond30;
}

std::unique_ptr<Program> make_program(ProgramKind kind, std::size_t geoms, std::uint64_t seed) {
  const auto or_own = [geoms](std::size_t own) { return geoms == 0 ? own : geoms; };
  switch (kind) {
    case ProgramKind::diamond10:
      return std::make_unique<DiamondProgram>(10);
    case ProgramKind::diamond30:
      return std::make_unique<DiamondProgram>(30);
    case ProgramKind::pile:
      return std::make_unique<PileProgram>(or_own(kPileBodies), seed);
    case ProgramKind::sleeping:
      return std::make_unique<SleepingProgram>(or_own(kSleepingBodies), seed);
    case ProgramKind::planner:
      return std::make_unique<PlannerProgram>(or_own(kPlates), Obstacles::plates, seed);
    case ProgramKind::clutter:
      return std::make_unique<PlannerProgram>(or_own(kPlates * kBoxesOfPlate), Obstacles::scanned,
                                              seed);
  }
  return nullptr;
}

}  // namespace harpoon::bench
