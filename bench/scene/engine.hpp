#pragma once

// One collision engine in the scene benchmark: given the bodies of a frame, it finds all contacts
// and says how long its steps took.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "harpoon/error.hpp"
#include "harpoon/records.hpp"

namespace harpoon::bench {

/// Milliseconds of the stages of Harpoon's stateless call.
struct StageMs {
  double survey = 0, order = 0, search = 0, contacts = 0;
};

/// Wall-clock milliseconds and counts of one frame.
struct EngineFrame {
  double update_ms = 0;  ///< poses into the engine, its structure brought up to date
  double broad_ms = 0;   ///< pairs found
  double narrow_ms = 0;  ///< contacts made
  std::uint64_t pairs = 0;
  std::uint64_t contacts = 0;
  StageMs stages = {};  ///< all zero where an engine has others

  [[nodiscard]] double total_ms() const { return update_ms + broad_ms + narrow_ms; }
};

class SceneEngine {
 public:
  virtual ~SceneEngine() = default;
  [[nodiscard]] virtual std::string name() const = 0;
  [[nodiscard]] virtual std::string precision() const = 0;  ///< "f32" or "f64"
  [[nodiscard]] virtual unsigned threads() const = 0;
  /// False where `contacts` says something else than how many spheres touch now.
  [[nodiscard]] virtual bool counts_contacts() const { return true; }
  /// Bytes that a frame must move at least: each body read and each contact written once, where an
  /// engine does not say otherwise.
  [[nodiscard]] virtual std::uint64_t floor_bytes(std::uint64_t bodies,
                                                  std::uint64_t contacts) const {
    const bool f64 = precision() == "f64";
    return bodies * (f64 ? sizeof(SphereF64) : sizeof(Sphere)) +
           contacts * (f64 ? sizeof(BodyContactF64) : sizeof(BodyContact));
  }
  /// `spheres` are always the same bodies, moved.
  virtual Result<EngineFrame> frame(std::span<const Sphere> spheres) = 0;
};

/// How Harpoon is called.
enum class HarpoonMode : std::uint8_t {
  detect,  ///< stateless, a kept workspace
  scene,   ///< a persistent scene
  still,   ///< a persistent scene in which nothing moves: no body is set, `detect` alone
  again,   ///< the same with all bodies set again where they are, which has to be found out
  bounds,  ///< overlapping pairs of the spheres' bounds
};
/// In the order of their rows.
inline constexpr std::array kHarpoonModes = {HarpoonMode::detect, HarpoonMode::scene,
                                             HarpoonMode::still, HarpoonMode::again,
                                             HarpoonMode::bounds};
std::unique_ptr<SceneEngine> make_harpoon_engine(HarpoonMode mode, bool f64, unsigned threads);

/// The peers; each on one thread. Null where this build has not got it.
std::unique_ptr<SceneEngine> make_embree_engine(std::span<const Sphere> spheres);
std::unique_ptr<SceneEngine> make_bullet_engine(std::span<const Sphere> spheres);
std::unique_ptr<SceneEngine> make_fcl_engine(std::span<const Sphere> spheres);
/// `space` is hash, sap or quadtree.
std::unique_ptr<SceneEngine> make_ode_engine(std::span<const Sphere> spheres,
                                             const std::string& space);

}  // namespace harpoon::bench
