#pragma once

// The world of the paper's section IV.B: spheres in the form of a diamond, pulled to its centre,
// run by ODE. The published set-up: no gravity, a hash space, dWorldQuickStep, CFM 1e-5, contacts
// with bounce 1.0 from 0.1 on, soft CFM 0.001 and infinite friction. It never measures anything.

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "bench/lattice.hpp"
#include "bench/ode/runtime.hpp"
#include "harpoon/error.hpp"
#include "harpoon/records.hpp"

struct dContactGeom;

namespace harpoon::bench {

/// SI units. The prototype publishes r = 0.1 and the time step; mass and force are ours.
struct DiamondParameters {
  unsigned h_max = 3;       ///< shells of spheres around the centre one, 0 to kMaxDiamondHMax
  double d_sph = 0;         ///< gap between neighbouring spheres at the start, >= 0
  double radius = 0.1;      ///< > 0
  double force = 10;        ///< on every sphere, toward the centre, newton, >= 0
  double mass = 1;          ///< of a sphere, kilogram, > 0
  double time_step = 0.01;  ///< second, > 0
};

/// ODE's hash space aborts the program beyond 131,071 geoms; 45 gives 125,671.
inline constexpr unsigned kMaxDiamondHMax = 45;

/// A pair that ODE's broad phase delivered, during the callback.
struct Candidate {
  IndexPair spheres;
  dxGeom* geom1;
  dxGeom* geom2;
  Flow flow;
  const ContactF64* contact;  ///< ODE's answer; null for Flow::fake
};

class DiamondWorld {
 public:
  /// Errors: invalid_argument, with the parameter and its range.
  static Result<std::unique_ptr<DiamondWorld>> create(const DiamondParameters& parameters);
  ~DiamondWorld();
  DiamondWorld(const DiamondWorld&) = delete;
  DiamondWorld& operator=(const DiamondWorld&) = delete;

  using Observer = std::function<void(const Candidate&)>;

  /// Broad phase, contacts (each candidate is shown to `observe`), forces, step.
  void step(const Observer& observe);

  /// The same step in two parts, unobserved. First broad phase and contacts; returns the number of
  /// candidates.
  std::uint64_t collide();
  /// Then forces, and the step with a joint for each contact found.
  void advance();
  [[nodiscard]] std::size_t contact_count() const;

  [[nodiscard]] std::size_t size() const { return bodies_.size(); }
  [[nodiscard]] Point position(std::size_t sphere) const;
  [[nodiscard]] std::vector<Point> positions() const;
  [[nodiscard]] const std::vector<dxBody*>& bodies() const { return bodies_; }
  [[nodiscard]] const DiamondParameters& parameters() const { return parameters_; }

 private:
  explicit DiamondWorld(const DiamondParameters& parameters);
  static void near(void* self, dxGeom* geom1, dxGeom* geom2);
  void meet(dxGeom* geom1, dxGeom* geom2);
  void join();
  void pull_to_centre();

  OdeRuntime runtime_;
  DiamondParameters parameters_;
  dxWorld* world_;
  dxSpace* space_;
  dxJointGroup* joints_;
  std::vector<dContactGeom> found_;     // of this step, in the order of the callbacks
  std::vector<std::uint32_t> indices_;  // geoms point into it
  std::vector<dxBody*> bodies_;
  const Observer* observer_ = nullptr;  // null where nobody looks
  std::uint64_t candidates_ = 0;
};

}  // namespace harpoon::bench
