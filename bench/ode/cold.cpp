#include "bench/ode/cold.hpp"

#include "bench/ode/geom_set.hpp"
#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

class OdeCold final : public Contestant {
 public:
  explicit OdeCold(const IndexedScene& scene) : scene_(scene), geoms_(scene.spheres) {}

  [[nodiscard]] const Label& label() const override { return label_; }

  Result<Turn> take_turn(std::size_t count) override {
    const auto pairs = std::span(scene_.pairs).first(count);
    return take_samples(runs_ns(pairs, 1).value(),
                        [&](std::uint64_t runs) { return runs_ns(pairs, runs); });
  }

 private:
  Result<double> runs_ns(std::span<const IndexPair> pairs, std::uint64_t runs) {
    const double start = now_ns();
    for (std::uint64_t i = 0; i < runs; ++i) {
      collide_all(geoms_, pairs);
    }
    return now_ns() - start;
  }

  Label label_{"ode", "f64", 1, "geoms", false, 128};
  const IndexedScene& scene_;
  GeomSet geoms_;
};

}  // namespace

std::unique_ptr<Contestant> make_ode_cold(const IndexedScene& scene) {
  return std::make_unique<OdeCold>(scene);
}

}  // namespace harpoon::bench
