// FCL: a dynamic AABB tree, its pairs collected, then fcl::collide with contacts for each.

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>

#include <memory>
#include <utility>
#include <vector>

#include "bench/scene/engine.hpp"
#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

using Object = fcl::CollisionObject<double>;
using Pairs = std::vector<std::pair<Object*, Object*>>;

bool collect(Object* a, Object* b, void* user) {
  static_cast<Pairs*>(user)->emplace_back(a, b);
  return false;
}

class FclEngine final : public SceneEngine {
 public:
  explicit FclEngine(std::span<const Sphere> spheres) {
    std::vector<Object*> pointers;
    for (const Sphere& s : spheres) {
      objects_.push_back(std::make_unique<Object>(
          std::make_shared<fcl::Sphere<double>>(static_cast<double>(s.r))));
      place(*objects_.back(), s);
      pointers.push_back(objects_.back().get());
    }
    manager_.registerObjects(pointers);
    manager_.setup();
  }

  [[nodiscard]] std::string name() const override { return "fcl"; }
  [[nodiscard]] std::string precision() const override { return "f64"; }
  [[nodiscard]] unsigned threads() const override { return 1; }

  Result<EngineFrame> frame(std::span<const Sphere> spheres) override {
    EngineFrame f;
    const double begin = now_ns();
    for (std::size_t i = 0; i < spheres.size(); ++i) place(*objects_[i], spheres[i]);
    manager_.update();
    const double updated = now_ns();
    pairs_.clear();
    manager_.collide(&pairs_, collect);
    const double found = now_ns();
    fcl::CollisionRequest<double> request;
    request.enable_contact = true;
    for (const auto& [a, b] : pairs_) {
      fcl::CollisionResult<double> result;
      f.contacts += fcl::collide(a, b, request, result) != 0 ? 1 : 0;
    }
    f.narrow_ms = (now_ns() - found) * 1e-6;
    f.broad_ms = (found - updated) * 1e-6;
    f.update_ms = (updated - begin) * 1e-6;
    f.pairs = pairs_.size();
    return f;
  }

 private:
  static void place(Object& object, const Sphere& s) {
    object.setTranslation(fcl::Vector3<double>(static_cast<double>(s.x), static_cast<double>(s.y),
                                               static_cast<double>(s.z)));
    object.computeAABB();
  }

  std::vector<std::unique_ptr<Object>> objects_;
  fcl::DynamicAABBTreeCollisionManager<double> manager_;
  Pairs pairs_;
};

}  // namespace

std::unique_ptr<SceneEngine> make_fcl_engine(std::span<const Sphere> spheres) {
  return std::make_unique<FclEngine>(spheres);
}

}  // namespace harpoon::bench
