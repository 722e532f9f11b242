// Stock ODE: one space, its pairs collected by the near callback, then dCollide for each.

#include <ode/ode.h>

#include <utility>
#include <vector>

#include "bench/ode/runtime.hpp"
#include "bench/scene/engine.hpp"
#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

using Pairs = std::vector<std::pair<dGeomID, dGeomID>>;

void collect(void* user, dGeomID a, dGeomID b) {
  static_cast<Pairs*>(user)->emplace_back(a, b);
}

dSpaceID make_space(const std::string& name, std::span<const Sphere> spheres) {
  if (name == "sap") return dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
  if (name == "hash") return dHashSpaceCreate(nullptr);
  dVector3 centre = {0, 0, 0, 0};
  dReal reach = 1;
  for (const Sphere& s : spheres) {
    const dReal p[3] = {static_cast<dReal>(s.x), static_cast<dReal>(s.y), static_cast<dReal>(s.z)};
    for (int k = 0; k < 3; ++k) {
      centre[k] += p[k] / static_cast<dReal>(spheres.size());
      reach = std::max(reach, std::abs(p[k]));
    }
  }
  const dVector3 extents = {2 * reach, 2 * reach, 2 * reach, 0};
  constexpr int kDepth = 6;
  return dQuadTreeSpaceCreate(nullptr, centre, extents, kDepth);
}

class OdeEngine final : public SceneEngine {
 public:
  OdeEngine(std::span<const Sphere> spheres, const std::string& space)
      : name_("ode " + space), space_(make_space(space, spheres)) {
    for (const Sphere& s : spheres) {
      geoms_.push_back(dCreateSphere(space_, static_cast<dReal>(s.r)));
      place(geoms_.back(), s);
    }
  }
  ~OdeEngine() override { dSpaceDestroy(space_); }

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::string precision() const override {
    return sizeof(dReal) == sizeof(float) ? "f32" : "f64";
  }
  [[nodiscard]] unsigned threads() const override { return 1; }

  Result<EngineFrame> frame(std::span<const Sphere> spheres) override {
    EngineFrame f;
    const double begin = now_ns();
    for (std::size_t i = 0; i < spheres.size(); ++i) place(geoms_[i], spheres[i]);
    const double updated = now_ns();
    pairs_.clear();
    dSpaceCollide(space_, &pairs_, collect);
    const double found = now_ns();
    contacts_.resize(pairs_.size());
    for (const auto& [a, b] : pairs_) {
      f.contacts += static_cast<std::uint64_t>(
          dCollide(a, b, 1, &contacts_[f.contacts], sizeof(dContactGeom)));
    }
    f.narrow_ms = (now_ns() - found) * 1e-6;
    f.broad_ms = (found - updated) * 1e-6;
    f.update_ms = (updated - begin) * 1e-6;
    f.pairs = pairs_.size();
    return f;
  }

 private:
  static void place(dGeomID geom, const Sphere& s) {
    dGeomSetPosition(geom, static_cast<dReal>(s.x), static_cast<dReal>(s.y),
                     static_cast<dReal>(s.z));
  }

  std::string name_;
  dSpaceID space_;
  std::vector<dGeomID> geoms_;
  Pairs pairs_;
  std::vector<dContactGeom> contacts_;
};

}  // namespace

std::unique_ptr<SceneEngine> make_ode_engine(std::span<const Sphere> spheres,
                                             const std::string& space) {
  return std::make_unique<OdeEngine>(spheres, space);
}

}  // namespace harpoon::bench
