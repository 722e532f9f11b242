// Embree 3: a low-quality (Morton) build per frame, rtcCollide of the scene with itself, then the
// contacts of the pairs.

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <vector>

#include "bench/scene/engine.hpp"
#include "bench/scene/sphere_contact.hpp"
#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

class EmbreeEngine final : public SceneEngine {
 public:
  explicit EmbreeEngine(std::span<const Sphere> spheres)
      : arena_(1), device_(rtcNewDevice("threads=1,set_affinity=0")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
    geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryBuildQuality(geometry_, RTC_BUILD_QUALITY_LOW);
    rtcSetGeometryUserPrimitiveCount(geometry_, static_cast<unsigned>(spheres.size()));
    rtcSetGeometryUserData(geometry_, this);
    rtcSetGeometryBoundsFunction(geometry_, bounds, nullptr);
    rtcAttachGeometry(scene_, geometry_);
  }
  ~EmbreeEngine() override {
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  [[nodiscard]] std::string name() const override { return "embree"; }
  [[nodiscard]] std::string precision() const override { return "f32"; }
  [[nodiscard]] unsigned threads() const override { return 1; }

  Result<EngineFrame> frame(std::span<const Sphere> spheres) override {
    EngineFrame f;
    spheres_ = spheres;
    arena_.execute([&] {
      const double begin = now_ns();
      rtcCommitGeometry(geometry_);
      rtcCommitScene(scene_);
      const double built = now_ns();
      pairs_.clear();
      rtcCollide(scene_, scene_, collect, this);
      const double found = now_ns();
      contacts_.resize(pairs_.size());
      for (const IndexPair& p : pairs_) {
        BodyContact& c = contacts_[f.contacts];
        if (sphere_contact(spheres[p.g1], spheres[p.g2], c)) {
          c.g1 = p.g1;
          c.g2 = p.g2;
          ++f.contacts;
        }
      }
      f.update_ms = (built - begin) * 1e-6;
      f.broad_ms = (found - built) * 1e-6;
      f.narrow_ms = (now_ns() - found) * 1e-6;
    });
    f.pairs = pairs_.size();
    return f;
  }

 private:
  static void bounds(const RTCBoundsFunctionArguments* args) {
    const auto* self = static_cast<const EmbreeEngine*>(args->geometryUserPtr);
    const Sphere& s = self->spheres_[args->primID];
    RTCBounds* b = args->bounds_o;
    b->lower_x = s.x - s.r;
    b->lower_y = s.y - s.r;
    b->lower_z = s.z - s.r;
    b->upper_x = s.x + s.r;
    b->upper_y = s.y + s.r;
    b->upper_z = s.z + s.r;
  }
  static void collect(void* user, RTCCollision* found, unsigned count) {
    auto& pairs = static_cast<EmbreeEngine*>(user)->pairs_;
    for (unsigned k = 0; k < count; ++k) {
      if (found[k].primID0 < found[k].primID1)
        pairs.push_back({found[k].primID0, found[k].primID1});
    }
  }

  tbb::task_arena arena_;
  RTCDevice device_;
  RTCScene scene_;
  RTCGeometry geometry_ = nullptr;
  std::span<const Sphere> spheres_;
  std::vector<IndexPair> pairs_;
  std::vector<BodyContact> contacts_;
};

}  // namespace

std::unique_ptr<SceneEngine> make_embree_engine(std::span<const Sphere> spheres) {
  return std::make_unique<EmbreeEngine>(spheres);
}

}  // namespace harpoon::bench
