// Harpoon through its public scene interface.

#include <vector>

#include "bench/scene/engine.hpp"
#include "bench/timer.hpp"
#include "harpoon/scene.hpp"

namespace harpoon::bench {
namespace {

template <class Real>
class HarpoonEngine final : public SceneEngine {
 public:
  HarpoonEngine(HarpoonMode mode, unsigned threads)
      : mode_(mode),
        threads_(threads),
        workspace_(Workspace::make({.threads = threads})),
        scene_(SceneOf<Real>::make({.threads = threads})) {}

  [[nodiscard]] std::string name() const override {
    switch (mode_) {
      case HarpoonMode::detect:
        return "harpoon";
      case HarpoonMode::scene:
        return "harpoon scene";
      case HarpoonMode::still:
        return "harpoon scene, still";
      case HarpoonMode::again:
        return "harpoon scene, set again";
      case HarpoonMode::bounds:
        break;
    }
    return "harpoon bounds";
  }
  [[nodiscard]] std::string precision() const override {
    return sizeof(Real) == sizeof(float) ? "f32" : "f64";
  }
  [[nodiscard]] unsigned threads() const override { return threads_; }
  [[nodiscard]] bool counts_contacts() const override {
    return mode_ == HarpoonMode::detect || mode_ == HarpoonMode::scene;
  }

  [[nodiscard]] std::uint64_t floor_bytes(std::uint64_t bodies,
                                          std::uint64_t contacts) const override {
    if (mode_ == HarpoonMode::still) return 0;
    // The caller's bodies and the scene's.
    if (mode_ == HarpoonMode::again) return 2 * bodies * sizeof(SphereOf<Real>);
    return SceneEngine::floor_bytes(bodies, contacts);
  }

  Result<EngineFrame> frame(std::span<const Sphere> spheres) override {
    if (!workspace_) return workspace_.error();
    if (!scene_) return scene_.error();
    const bool first = spheres_.empty();
    if (first || (mode_ != HarpoonMode::still && mode_ != HarpoonMode::again)) {
      spheres_.clear();
      for (const Sphere& s : spheres) spheres_.push_back({s.x, s.y, s.z, s.r});
    }
    if (mode_ == HarpoonMode::bounds) {
      boxes_.clear();
      for (const SphereOf<Real>& s : spheres_) {
        boxes_.insert(boxes_.end(),
                      {s.x - s.r, s.x + s.r, s.y - s.r, s.y + s.r, s.z - s.r, s.z + s.r});
      }
      return bounds_frame();
    }
    if (mode_ == HarpoonMode::detect) return detect_frame();
    return scene_frame(mode_ != HarpoonMode::still || first);
  }

 private:
  /// Milliseconds of a call's stages; the update takes what the others leave of `total_ns`.
  static EngineFrame staged(const StageTimes& t, double total_ns) {
    EngineFrame f;
    f.broad_ms = t.search_ns * 1e-6;
    f.narrow_ms = t.contacts_ns * 1e-6;
    f.update_ms = total_ns * 1e-6 - f.broad_ms - f.narrow_ms;
    f.stages = {t.survey_ns * 1e-6, t.order_ns * 1e-6, f.broad_ms, f.narrow_ms};
    return f;
  }

  Result<EngineFrame> bounds_frame() {
    const BoundsOf<Real> boxes(boxes_.data(), spheres_.size());
    const double begin = now_ns();
    auto report = overlap_pairs(*workspace_, boxes, std::span(pairs_));
    const double end = now_ns();
    if (!report && report.error().code == Errc::capacity) {
      pairs_.resize(report.error().needed + report.error().needed / 2);
      return bounds_frame();
    }
    if (!report) return report.error();
    EngineFrame f = staged(report->times, end - begin);
    f.pairs = report->tests;
    f.contacts = report->contacts;
    return f;
  }

  Result<EngineFrame> detect_frame() {
    const BodiesOf<Real> bodies{std::span<const SphereOf<Real>>(spheres_)};
    const double begin = now_ns();
    auto report = detect(*workspace_, bodies, std::span(contacts_));
    const double end = now_ns();
    if (!report && report.error().code == Errc::capacity) {
      contacts_.resize(report.error().needed + report.error().needed / 2);
      return detect_frame();
    }
    if (!report) return report.error();
    EngineFrame f = staged(report->times, end - begin);
    f.pairs = report->tests;
    f.contacts = report->contacts;
    return f;
  }

  Result<EngineFrame> scene_frame(bool set) {
    const BodiesOf<Real> bodies{std::span<const SphereOf<Real>>(spheres_)};
    const double begin = now_ns();
    if (set) {
      if (auto error = scene_->set_bodies(bodies)) return *std::move(error);
    }
    const double moved = now_ns();
    const auto frame = scene_->detect();
    const double end = now_ns();
    if (!frame) return frame.error();
    EngineFrame f;
    f.update_ms = (moved - begin) * 1e-6;
    f.broad_ms = (end - moved) * 1e-6;
    f.contacts = f.pairs = frame->contacts.size();
    return f;
  }

  HarpoonMode mode_;
  unsigned threads_;
  Result<Workspace> workspace_;
  Result<SceneOf<Real>> scene_;
  std::vector<SphereOf<Real>> spheres_;
  std::vector<BodyContactOf<Real>> contacts_;
  std::vector<Real> boxes_;
  std::vector<IndexPair> pairs_;
};

}  // namespace

std::unique_ptr<SceneEngine> make_harpoon_engine(HarpoonMode mode, bool f64, unsigned threads) {
  if (f64) return std::make_unique<HarpoonEngine<double>>(mode, threads);
  return std::make_unique<HarpoonEngine<float>>(mode, threads);
}

}  // namespace harpoon::bench
