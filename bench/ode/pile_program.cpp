#include "bench/ode/pile_program.hpp"

#include <cmath>

#include "bench/ode/numbers.hpp"

namespace harpoon::bench {
namespace {

constexpr double kDensity = 1000;
/// Metres from one body to the next at the start: no two touch.
constexpr double kSpacing = 0.7;
/// The pile starts about twice as high as it is wide.
constexpr double kHeightOverWidth = 2;

dGeomID make_shape(std::size_t number, double scale, dMass& mass) {
  switch (number % 3) {
    case 0:
      dMassSetSphere(&mass, kDensity, 0.25 * scale);
      return dCreateSphere(nullptr, 0.25 * scale);
    case 1:
      dMassSetBox(&mass, kDensity, 0.4 * scale, 0.45 * scale, 0.3 * scale);
      return dCreateBox(nullptr, 0.4 * scale, 0.45 * scale, 0.3 * scale);
    default:
      dMassSetCapsule(&mass, kDensity, 3, 0.18 * scale, 0.24 * scale);
      return dCreateCapsule(nullptr, 0.18 * scale, 0.24 * scale);
  }
}

}  // namespace

PileProgram::PileProgram(std::size_t bodies, std::uint64_t seed) {
  Numbers numbers(seed);
  const auto across = static_cast<std::size_t>(
      std::ceil(std::cbrt(static_cast<double>(bodies) / kHeightOverWidth)));
  const double width = kSpacing * static_cast<double>(across);
  add_plane(0, 0, 1, 0);
  add_plane(1, 0, 0, 0);
  add_plane(-1, 0, 0, -width);
  add_plane(0, 1, 0, 0);
  add_plane(0, -1, 0, -width);
  for (std::size_t number = 0; number < bodies; ++number) {
    const auto place = [&](std::size_t cell) {
      return kSpacing * (static_cast<double>(cell) + 0.5) + 0.05 * numbers.next();
    };
    dMass mass;
    const dGeomID geom = make_shape(number, numbers.between(0.8, 1.2), mass);
    const double x = place(number % across), y = place(number / across % across),
                 z = place(number / (across * across));
    add_body(geom, mass, x, y, z);
  }
}

}  // namespace harpoon::bench
