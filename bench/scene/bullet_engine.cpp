// Bullet: a collision world with the dynamic AABB tree (btDbvtBroadphase) and its default
// dispatcher.

#include <btBulletCollisionCommon.h>

#include <memory>
#include <vector>

#include "bench/scene/engine.hpp"
#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

/// Takes every pair.
struct AllPairs final : btOverlapCallback {
  bool processOverlap(btBroadphasePair&) override { return true; }
};

class BulletEngine final : public SceneEngine {
 public:
  explicit BulletEngine(std::span<const Sphere> spheres)
      : dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &configuration_) {
    world_.setForceUpdateAllAabbs(false);
    for (const Sphere& s : spheres) {
      shapes_.push_back(std::make_unique<btSphereShape>(s.r));
      auto object = std::make_unique<btCollisionObject>();
      object->setCollisionShape(shapes_.back().get());
      object->getWorldTransform().setIdentity();
      object->getWorldTransform().setOrigin({s.x, s.y, s.z});
      world_.addCollisionObject(object.get());
      objects_.push_back(std::move(object));
    }
  }
  ~BulletEngine() override {
    // Removing an object looks through all pairs: with pairs left that takes minutes.
    AllPairs all;
    world_.getPairCache()->processAllOverlappingPairs(&all, &dispatcher_);
    for (const auto& object : objects_) world_.removeCollisionObject(object.get());
  }

  [[nodiscard]] std::string name() const override { return "bullet"; }
  [[nodiscard]] std::string precision() const override { return "f32"; }
  [[nodiscard]] unsigned threads() const override { return 1; }

  Result<EngineFrame> frame(std::span<const Sphere> spheres) override {
    EngineFrame f;
    const double begin = now_ns();
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      objects_[i]->getWorldTransform().setOrigin({spheres[i].x, spheres[i].y, spheres[i].z});
    }
    world_.updateAabbs();
    const double updated = now_ns();
    world_.computeOverlappingPairs();
    const double found = now_ns();
    dispatcher_.dispatchAllCollisionPairs(world_.getPairCache(), world_.getDispatchInfo(),
                                          &dispatcher_);
    f.narrow_ms = (now_ns() - found) * 1e-6;
    f.broad_ms = (found - updated) * 1e-6;
    f.update_ms = (updated - begin) * 1e-6;
    f.pairs = static_cast<std::uint64_t>(world_.getPairCache()->getNumOverlappingPairs());
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
      const btPersistentManifold* manifold = dispatcher_.getManifoldByIndexInternal(m);
      f.contacts += static_cast<std::uint64_t>(manifold->getNumContacts());
    }
    return f;
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btCollisionWorld world_;
  std::vector<std::unique_ptr<btSphereShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
};

}  // namespace

std::unique_ptr<SceneEngine> make_bullet_engine(std::span<const Sphere> spheres) {
  return std::make_unique<BulletEngine>(spheres);
}

}  // namespace harpoon::bench
