#pragma once

/// The scene door: bodies in, all contacts out. Spheres, float and double; for other shapes all
/// pairs whose bounds overlap.
///
/// `detect` looks at one frame and remembers nothing. `Scene` (SceneF64) keeps bodies, nearby pairs
/// and memory between frames: faster when bodies move little, nearly free when none moves.
/// `overlap_pairs` takes axis-aligned boxes of anything and leaves the collider to the caller.
///
/// `detect` and `Scene` find exactly the pairs that the collider finds when it is given all pairs
/// (after filters), and each contact has the bits of `collide` for {body g1, body g2} with g1 < g2.
/// Neither the set of contacts nor their order depends on threads, instruction set or earlier
/// calls.
///
/// Bodies with a coordinate or radius that is not finite, a coordinate beyond +-`kSceneLimit`, or a
/// radius below 0 or beyond `kSceneLimit` take part in nothing and are reported by id; everything
/// else stays exact. Radius 0 is legal. Cost grows as n log n + contacts whatever the extent of the
/// world and the sizes in it, memory with bodies and contacts.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harpoon/device.hpp"
#include "harpoon/error.hpp"
#include "harpoon/export.hpp"
#include "harpoon/records.hpp"

namespace harpoon {

/// Most bodies of a call or a scene: 2^31 - 1.
inline constexpr std::uint64_t kMaxBodies = (std::uint64_t{1} << 31) - 1;

/// Largest magnitude of a coordinate or radius: distances and their squares stay finite.
template <class Real>
inline constexpr Real kSceneLimit = sizeof(Real) == 4 ? Real(0x1p62) : Real(0x1p510);

/// Whether a body takes part of its own accord. Two bodies that both rest have no contact.
enum class Rest : std::uint8_t {
  awake = 0,
  asleep = 1,  ///< at rest until the caller wakes it
  fixed = 2,   ///< static: never moves of its own accord
};

/// Which pairs count. One element per body, by id, or empty for none of that rule. Views only.
struct Filters {
  /// ODE's rule: a pair counts when (category1 & collide2) || (category2 & collide1). Both or
  /// neither must be given.
  std::span<const std::uint32_t> category = {};
  std::span<const std::uint32_t> collide = {};
  /// Bodies of one owner do not touch each other; 0 is nobody.
  std::span<const std::uint32_t> owner = {};
  std::span<const Rest> rest = {};
};

/// Centres and radii in the caller's memory: four arrays of `count` numbers, each number
/// `stride_bytes` after the one before. Body i of the view has id i. Views only: the memory must
/// stay unchanged during a call.
template <class Real>
struct BodiesOf {
  const Real* x = nullptr;
  const Real* y = nullptr;
  const Real* z = nullptr;
  const Real* r = nullptr;
  std::size_t stride_bytes = sizeof(Real);
  std::size_t count = 0;
  Filters filters = {};

  BodiesOf() = default;
  /// Records {x, y, z, r}.
  BodiesOf(std::span<const SphereOf<Real>> spheres)  // NOLINT(google-explicit-constructor)
      : BodiesOf(spheres.empty() ? nullptr : &spheres[0].x, sizeof(SphereOf<Real>),
                 spheres.size()) {}
  /// Four separate arrays.
  BodiesOf(const Real* xs, const Real* ys, const Real* zs, const Real* rs, std::size_t bodies)
      : x(xs), y(ys), z(zs), r(rs), count(bodies) {}
  /// x, y, z, r side by side within records of `record_bytes`, a multiple of the alignment of Real.
  BodiesOf(const Real* first_x, std::size_t record_bytes, std::size_t bodies)
      : x(first_x),
        y(first_x == nullptr ? nullptr : first_x + 1),
        z(first_x == nullptr ? nullptr : first_x + 2),
        r(first_x == nullptr ? nullptr : first_x + 3),
        stride_bytes(record_bytes),
        count(bodies) {}
};

using Bodies = BodiesOf<float>;
using BodiesF64 = BodiesOf<double>;

/// Axis-aligned boxes in the caller's memory, six numbers each: min x, max x, min y, max y, min z,
/// max z (ODE's order); one box `stride_bytes` after the other. Box i has id i. Boxes are closed:
/// they overlap where they only touch. An extent may be 0 or infinite. Views only, as `BodiesOf`.
template <class Real>
struct BoundsOf {
  const Real* first = nullptr;
  std::size_t stride_bytes = 6 * sizeof(Real);
  std::size_t count = 0;
  Filters filters = {};

  BoundsOf() = default;
  /// `box_bytes` is a multiple of the alignment of Real.
  BoundsOf(const Real* first_min_x, std::size_t boxes, std::size_t box_bytes = 6 * sizeof(Real))
      : first(first_min_x), stride_bytes(box_bytes), count(boxes) {}
};

using Bounds = BoundsOf<float>;
using BoundsF64 = BoundsOf<double>;

/// The order of results.
enum class ContactOrder : std::uint8_t {
  /// The order in which the search finds them, the cheapest: bodies in space order, and for each
  /// block of them its partners row by row (docs/scene.md gives the full rule). A function of the
  /// bodies and their ids alone.
  space,
  /// Ascending (g1, g2).
  ids,
};

/// How a call is carried out. None of this changes its results.
struct WorkspaceOptions {
  /// Most threads to use, 1 to 1024; 0 means one per hardware thread. Small calls stay on the
  /// calling thread whatever this says.
  unsigned threads = 0;
  /// Replaces oneTBB.
  ParallelFor parallel_for = {};
  /// As in `CpuOptions`.
  std::string instruction_set = {};
};

/// Threads and scratch memory for `detect`, kept from call to call to save their making. It holds
/// no history. For one call at a time; any number of them may work at once. Movable.
class HARPOON_API Workspace {
 public:
  /// Errors: invalid_argument (unknown instruction set, too many threads), out_of_memory.
  static Result<Workspace> make(const WorkspaceOptions& options = {}) noexcept;
  Workspace(Workspace&& other) noexcept;
  Workspace& operator=(Workspace&& other) noexcept;
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
  ~Workspace();

  /// Scratch memory held.
  [[nodiscard]] std::size_t bytes() const noexcept;

  struct State;
  [[nodiscard]] State& state() const noexcept { return *state_; }

 private:
  explicit Workspace(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

/// Where the time of a call went, in nanoseconds of wall clock.
struct StageTimes {
  double survey_ns = 0;    ///< bounds, validity, choice of grids (of boxes part of order_ns)
  double order_ns = 0;     ///< bodies into space order
  double search_ns = 0;    ///< candidate pairs
  double contacts_ns = 0;  ///< exact test, contacts, output
};

/// What a call did.
struct DetectReport {
  std::uint64_t contacts = 0;
  std::uint64_t tests = 0;              ///< pairs whose distance was looked at
  std::vector<std::uint32_t> excluded;  ///< ids of invalid bodies, ascending
  StageTimes times;
};

/// All contacts among `bodies`, written to the front of `out`.
/// Errors: capacity (`needed` is the exact number; nothing written), invalid_argument (null array,
/// filter of another length), batch_too_large, out_of_memory, executor_failed. `out` is untouched
/// on capacity and argument errors and unspecified on others. Thread-safe for different workspaces.
HARPOON_API Result<DetectReport> detect(Workspace& workspace, const Bodies& bodies,
                                        std::span<BodyContact> out,
                                        ContactOrder order = ContactOrder::space) noexcept;
HARPOON_API Result<DetectReport> detect(Workspace& workspace, const BodiesF64& bodies,
                                        std::span<BodyContactF64> out,
                                        ContactOrder order = ContactOrder::space) noexcept;

/// The same with scratch memory of its own, for callers that detect now and then.
HARPOON_API Result<DetectReport> detect(const Bodies& bodies, std::span<BodyContact> out,
                                        ContactOrder order = ContactOrder::space,
                                        const WorkspaceOptions& options = {}) noexcept;
HARPOON_API Result<DetectReport> detect(const BodiesF64& bodies, std::span<BodyContactF64> out,
                                        ContactOrder order = ContactOrder::space,
                                        const WorkspaceOptions& options = {}) noexcept;

/// The pairs (g1 < g2) of those contacts, in the same order. Errors as `detect`.
HARPOON_API Result<DetectReport> detect_pairs(Workspace& workspace, const Bodies& bodies,
                                              std::span<IndexPair> out,
                                              ContactOrder order = ContactOrder::space) noexcept;
HARPOON_API Result<DetectReport> detect_pairs(Workspace& workspace, const BodiesF64& bodies,
                                              std::span<IndexPair> out,
                                              ContactOrder order = ContactOrder::space) noexcept;

/// Their number only. Errors as `detect`, without capacity.
HARPOON_API Result<DetectReport> count_contacts(Workspace& workspace,
                                                const Bodies& bodies) noexcept;
HARPOON_API Result<DetectReport> count_contacts(Workspace& workspace,
                                                const BodiesF64& bodies) noexcept;

/// All pairs g1 < g2 of boxes that overlap and pass the filters, written to the front of `out`;
/// exact in both precisions. Boxes with a NaN or a min beyond its max take part in nothing and are
/// listed in `excluded`. `contacts` of the report is the number of pairs. Boxes that are infinite
/// or huge beside the rest cost what they overlap; where most are so along the same one or two
/// axes, they are told apart by the others. Boxes with sides that differ more than about a
/// hundredfold, in several directions, cost more (docs/scene.md). Errors as `detect`.
HARPOON_API Result<DetectReport> overlap_pairs(Workspace& workspace, const Bounds& boxes,
                                               std::span<IndexPair> out,
                                               ContactOrder order = ContactOrder::space) noexcept;
HARPOON_API Result<DetectReport> overlap_pairs(Workspace& workspace, const BoundsF64& boxes,
                                               std::span<IndexPair> out,
                                               ContactOrder order = ContactOrder::space) noexcept;

/// How a body of a scene is filtered; see `Filters`.
struct BodyRules {
  std::uint32_t category = 1;
  std::uint32_t collide = 0xFFFFFFFF;
  std::uint32_t owner = 0;
  Rest rest = Rest::awake;
};

/// Contacts that a frame of a scene of so many bodies may have where the client sets no limit. A
/// scene keeps them in its own memory, and bodies that coincide have half the square of their
/// number.
constexpr std::uint64_t default_contact_limit(std::uint64_t bodies) noexcept {
  constexpr std::uint64_t kAtLeast = std::uint64_t{1} << 24;
  constexpr std::uint64_t kPerBody = 64;
  return bodies > kAtLeast / kPerBody ? kPerBody * bodies : kAtLeast;
}

/// One frame of a scene.
template <class Real>
struct FrameOf {
  /// In ascending order of (g1, g2). Valid until the scene is next used.
  std::span<const BodyContactOf<Real>> contacts;
  /// Ids of invalid bodies, ascending. Valid as long.
  std::span<const std::uint32_t> excluded;
  bool changed = true;      ///< false: nothing moved, these are the contacts of the last frame
  bool searched = false;    ///< true: nearby pairs were searched anew
  std::uint64_t tests = 0;  ///< pairs whose distance was looked at
};

/// Bodies that persist. Contacts are those of `detect` on the bodies as they are, in order of ids,
/// whatever happened before. Ids are small: a new body gets the lowest free one.
///
/// How it is fast: a search keeps all pairs that are in contact or nearly so; as long as no body
/// has moved more than half of what "nearly" means since then, only those are looked at. The margin
/// follows the bodies' speed; bodies that move too far in each frame are searched in every frame.
///
/// Not thread-safe: one call at a time. After an error the scene holds its bodies and can be used.
template <class Real>
class HARPOON_API SceneOf {
 public:
  /// Errors: as `Workspace::make`.
  static Result<SceneOf> make(const WorkspaceOptions& options = {}) noexcept;
  SceneOf(SceneOf&& other) noexcept;
  SceneOf& operator=(SceneOf&& other) noexcept;
  SceneOf(const SceneOf&) = delete;
  SceneOf& operator=(const SceneOf&) = delete;
  ~SceneOf();

  /// Makes the scene's bodies those of the view, ids and filters included: the way to move all of
  /// them at once. Errors: as `detect`; then the scene is as before, or empty on out_of_memory and
  /// executor_failed. Where nothing has moved, call nothing: to find that out for all of them costs
  /// a comparison of their memory.
  std::optional<Error> set_bodies(const BodiesOf<Real>& bodies) noexcept;

  /// Adds a body and returns its id. Errors: out_of_memory, batch_too_large.
  Result<std::uint32_t> add(const SphereOf<Real>& sphere, const BodyRules& rules = {}) noexcept;
  /// The others: errors invalid_index (no such body), out_of_memory (set_rules).
  std::optional<Error> remove(std::uint32_t id) noexcept;
  std::optional<Error> move(std::uint32_t id, const SphereOf<Real>& sphere) noexcept;
  std::optional<Error> set_rules(std::uint32_t id, const BodyRules& rules) noexcept;

  /// Bodies in the scene.
  [[nodiscard]] std::size_t size() const noexcept;

  /// Sets the most contacts that a frame may have, in place of `default_contact_limit`.
  void limit_contacts(std::uint64_t most) noexcept;

  /// All contacts of the bodies as they are now. Errors: capacity (more than the limit; `needed` is
  /// their exact number), out_of_memory, executor_failed, batch_too_large (more than 2^32 - 1
  /// nearby pairs).
  Result<FrameOf<Real>> detect() noexcept;

  struct State;

 private:
  explicit SceneOf(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

using Scene = SceneOf<float>;
using SceneF64 = SceneOf<double>;

}  // namespace harpoon
