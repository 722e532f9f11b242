// One subject of `bench ode`, step after step and nothing else: to be counted with stock libode and
// with the drop-in preloaded (cost_test.py).
//
//     ode_cost_program KIND SPACE GEOMS STEPS      a world of the drop-in's benchmark
//     ode_cost_program PROGRAM - GEOMS STEPS       a whole program

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "bench/ode/runtime.hpp"
#include "bench/ode/twin.hpp"

namespace {

using namespace harpoon::bench;

std::optional<Subject> subject_of(std::string_view name, std::string_view space,
                                  std::uint64_t geoms) {
  if (const auto program = parse_program_kind(name)) return ProgramSubject{*program, geoms, 1};
  const auto kind = parse_drop_in_kind(name);
  for (std::size_t k = 0; k < kSpaceKinds && kind; ++k) {
    const auto known = static_cast<SpaceKind>(k);
    if (to_string(known) == space) return WorldSubject{*kind, known, geoms, 1};
  }
  return std::nullopt;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 5) return 2;
  const OdeRuntime ode;
  const auto subject =
      subject_of(arguments[1], arguments[2], std::strtoull(arguments[3], nullptr, 10));
  if (!subject) return 2;
  SubjectRun run(*subject);
  const TwinTurn turn =
      run.turn(static_cast<unsigned>(std::strtoul(arguments[4], nullptr, 10)), false);
  std::uint64_t pairs = 0, contacts = 0;
  for (const TimedStep& step : turn.steps) {
    pairs += step.work.pairs;
    contacts += step.work.contacts;
  }
  std::printf("%llu pairs, %llu contacts\n", static_cast<unsigned long long>(pairs),
              static_cast<unsigned long long>(contacts));
}
