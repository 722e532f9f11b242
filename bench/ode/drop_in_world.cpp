#include "bench/ode/drop_in_world.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "bench/ode/numbers.hpp"
#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

constexpr std::array<std::pair<std::string_view, DropInKind>, 7> kKinds = {{
    {"packed", DropInKind::packed},
    {"gas", DropInKind::gas},
    {"mixed", DropInKind::mixed},
    {"asleep", DropInKind::asleep},
    {"chain", DropInKind::chain},
    {"fallen", DropInKind::fallen},
    {"cars", DropInKind::cars},
}};
constexpr std::array<std::string_view, kSpaceKinds> kSpaces = {"simple", "hash", "sap", "quadtree"};
constexpr double kRadius = 0.5;
constexpr double kGasShare = 0.05;
/// Of the lattice's bodies, in each direction.
constexpr double kJitter = 0.05 * kRadius;
/// Of every body in each step and direction.
constexpr double kMove = 0.02 * kRadius;
constexpr int kMaxContacts = 8;
/// 64 x 64 squares of two triangles.
constexpr int kGroundSquares = 64;
constexpr int kQuadtreeDepth = 6;
/// Of neighbours in a chain.
constexpr double kChainGap = 1.9 * kRadius;
/// One of so many has fallen, by so many metres a geom.
constexpr std::size_t kFallenShare = 20;
constexpr double kFallMetres = 1e5;
/// Geoms of a car, between two of which there are so many metres.
constexpr std::size_t kCarGeoms = 5;
constexpr double kCarGap = 0.8 * kRadius;

dSpaceID make_space(SpaceKind kind, double extent) {
  const dVector3 center = {extent, extent, extent, 0}, extents = {extent, extent, extent, 0};
  switch (kind) {
    case SpaceKind::simple:
      return dSimpleSpaceCreate(nullptr);
    case SpaceKind::hash:
      return dHashSpaceCreate(nullptr);
    case SpaceKind::sap:
      return dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
    case SpaceKind::quadtree:
      return dQuadTreeSpaceCreate(nullptr, center, extents, kQuadtreeDepth);
  }
  return nullptr;
}

struct Point {
  double x, y, z;
};

std::vector<Point> lattice_points(std::size_t count, double& extent, Numbers& numbers) {
  const double edge = 2 * std::numbers::sqrt2 * kRadius;
  const auto cells = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(count) / 4)));
  extent = static_cast<double>(cells) * edge / 2;
  constexpr Point kCell[4] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  std::vector<Point> points;
  for (std::size_t cell = 0; points.size() < count; ++cell) {
    const std::size_t layer = cell / (cells * cells);
    const auto i = static_cast<double>(layer);
    const auto j = static_cast<double>(cell / cells % cells), k = static_cast<double>(cell % cells);
    for (const Point& at : kCell) {
      if (points.size() == count) break;
      const auto place = [&](double whole, double part) {
        return (whole + part) * edge + numbers.next() * kJitter;
      };
      const double x = place(i, at.x), y = place(j, at.y), z = place(k, at.z);
      points.push_back({x, y, z});
    }
  }
  return points;
}

std::vector<Point> gas_points(std::size_t count, double& extent, Numbers& numbers) {
  const double ball = 4.0 / 3 * std::numbers::pi * kRadius * kRadius * kRadius;
  extent = std::cbrt(static_cast<double>(count) * ball / kGasShare) / 2;
  std::vector<Point> points(count);
  for (Point& p : points) {
    p.x = (numbers.next() + 1) * extent;
    p.y = (numbers.next() + 1) * extent;
    p.z = (numbers.next() + 1) * extent;
  }
  return points;
}

std::vector<Point> chain_points(std::size_t count, double& extent) {
  std::vector<Point> points(count);
  for (std::size_t k = 0; k < count; ++k) points[k] = {static_cast<double>(k) * kChainGap, 1, 1};
  extent = static_cast<double>(count) * kChainGap / 2;
  return points;
}

/// Like gas, but what has fallen is at depths of its own.
std::vector<Point> fallen_points(std::size_t count, double& extent, Numbers& numbers) {
  std::vector<Point> points = gas_points(count, extent, numbers);
  for (std::size_t k = 0; k < count; k += kFallenShare) {
    points[k].z -= kFallMetres * static_cast<double>(1 + k);
  }
  return points;
}

/// Cars are where the geoms of a gas would be.
std::vector<Point> car_points(std::size_t count, double& extent, Numbers& numbers) {
  std::vector<Point> points =
      gas_points((count + kCarGeoms - 1) / kCarGeoms * kCarGeoms, extent, numbers);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Point& car = points[k - k % kCarGeoms];
    points[k] = {car.x + static_cast<double>(k % kCarGeoms) * kCarGap, car.y, car.z};
  }
  points.resize(count);
  return points;
}

std::vector<Point> make_points(DropInKind kind, std::size_t count, double& extent,
                               Numbers& numbers) {
  switch (kind) {
    case DropInKind::gas:
      return gas_points(count, extent, numbers);
    case DropInKind::chain:
      return chain_points(count, extent);
    case DropInKind::fallen:
      return fallen_points(count, extent, numbers);
    case DropInKind::cars:
      return car_points(count, extent, numbers);
    case DropInKind::packed:
    case DropInKind::mixed:
    case DropInKind::asleep:
      break;
  }
  return lattice_points(count, extent, numbers);
}

dGeomID make_shape(DropInKind kind, std::size_t number) {
  if (kind == DropInKind::mixed && number % 3 == 1) {
    return dCreateBox(nullptr, 1.8 * kRadius, 1.8 * kRadius, 1.8 * kRadius);
  }
  if (kind == DropInKind::mixed && number % 3 == 2) {
    return dCreateCapsule(nullptr, 0.7 * kRadius, kRadius);
  }
  return dCreateSphere(nullptr, kRadius);
}

struct Walk {
  std::uint64_t pairs = 0, contacts = 0, hash = 0;

  void mix(std::uint64_t value) { hash = (hash ^ value) * 0x9E3779B97F4A7C15u + (hash >> 29); }
};

void near(void* data, dGeomID o1, dGeomID o2) {
  if (dGeomIsSpace(o1) != 0 || dGeomIsSpace(o2) != 0) return dSpaceCollide2(o1, o2, data, &near);
  Walk& walk = *static_cast<Walk*>(data);
  dContactGeom contacts[kMaxContacts];
  ++walk.pairs;
  walk.contacts +=
      static_cast<std::uint64_t>(dCollide(o1, o2, kMaxContacts, contacts, sizeof(dContactGeom)));
}

void near_hashed(void* data, dGeomID o1, dGeomID o2) {
  if (dGeomIsSpace(o1) != 0 || dGeomIsSpace(o2) != 0) {
    return dSpaceCollide2(o1, o2, data, &near_hashed);
  }
  Walk& walk = *static_cast<Walk*>(data);
  dContactGeom contacts[kMaxContacts];
  const int count = dCollide(o1, o2, kMaxContacts, contacts, sizeof(dContactGeom));
  ++walk.pairs;
  walk.contacts += static_cast<std::uint64_t>(count);
  walk.mix(reinterpret_cast<std::uintptr_t>(dGeomGetData(o1)));
  walk.mix(reinterpret_cast<std::uintptr_t>(dGeomGetData(o2)));
  for (int k = 0; k < count; ++k) {
    const dContactGeom& c = contacts[k];
    for (const dReal value :
         {c.pos[0], c.pos[1], c.pos[2], c.normal[0], c.normal[1], c.normal[2], c.depth}) {
      walk.mix(std::bit_cast<std::uint64_t>(static_cast<double>(value)));
    }
  }
}

}  // namespace

std::optional<DropInKind> parse_drop_in_kind(std::string_view name) {
  for (const auto& [known, kind] : kKinds) {
    if (known == name) return kind;
  }
  return std::nullopt;
}

std::string_view to_string(DropInKind kind) {
  return kKinds[static_cast<std::size_t>(kind)].first;
}

std::string_view to_string(SpaceKind kind) {
  return kSpaces[static_cast<std::size_t>(kind)];
}

DropInWorld::DropInWorld(DropInKind kind, SpaceKind space, std::size_t geoms, std::uint64_t seed)
    : kind_(kind), seed_(seed), world_(dWorldCreate()) {
  Numbers numbers(seed);
  std::vector<Point> points = make_points(kind, geoms, extent_, numbers);
  // Neighbours in space are none in memory, as in a program that has run for a while.
  for (std::size_t i = points.size(); i > 1 && kind != DropInKind::cars; --i) {
    std::swap(points[i - 1], points[numbers.bits() % i]);
  }
  space_ = make_space(space, extent_);
  home_ = space_;
  for (std::size_t number = 0; number < points.size(); ++number) {
    if (kind == DropInKind::cars && number % kCarGeoms == 0) home_ = dSimpleSpaceCreate(space_);
    add(make_shape(kind, number), points[number].x, points[number].y, points[number].z);
  }
  if (kind == DropInKind::mixed) add_ground();
}

DropInWorld::~DropInWorld() {
  dSpaceDestroy(space_);
  if (mesh_ != nullptr) dGeomTriMeshDataDestroy(mesh_);
  dWorldDestroy(world_);
}

void DropInWorld::add(dGeomID geom, double x, double y, double z) {
  const dBodyID body = dBodyCreate(world_);
  dGeomSetData(geom, reinterpret_cast<void*>(bodies_.size()));
  dGeomSetBody(geom, body);
  dBodySetPosition(body, x, y, z);
  dSpaceAdd(home_, geom);
  bodies_.push_back({body, x, y, z});
}

void DropInWorld::add_ground() {
  constexpr int kSide = kGroundSquares + 1;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const auto at = [&](int k) { return static_cast<float>(extent_ * 2.0 * k / kGroundSquares); };
      vertices_.insert(vertices_.end(), {at(i), at(j), -0.25f});
    }
  }
  for (int i = 0; i < kGroundSquares; ++i) {
    for (int j = 0; j < kGroundSquares; ++j) {
      const auto corner = static_cast<dTriIndex>(i * kSide + j);
      const auto next = static_cast<dTriIndex>(corner + kSide);
      triangles_.insert(triangles_.end(), {corner, next, corner + 1, corner + 1, next, next + 1});
    }
  }
  mesh_ = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildSingle(mesh_, vertices_.data(), 3 * sizeof(float), kSide * kSide,
                              triangles_.data(), static_cast<int>(triangles_.size()),
                              3 * sizeof(dTriIndex));
  const dGeomID ground = dCreateTriMesh(space_, mesh_, nullptr, nullptr, nullptr);
  dGeomSetData(ground, reinterpret_cast<void*>(bodies_.size()));
}

void DropInWorld::move() {
  if (kind_ == DropInKind::asleep) return;
  Numbers numbers(seed_ * 1000003 + steps_++);
  for (const Body& b : bodies_) {
    const double x = numbers.next() * kMove, y = numbers.next() * kMove, z = numbers.next() * kMove;
    dBodySetPosition(b.body, b.x + x, b.y + y, b.z + z);
  }
}

Program::Work DropInWorld::collide(dNearCallback* callback) {
  Walk walk;
  const double begin_ns = now_ns();
  dSpaceCollide(space_, &walk, callback);
  const double collision_ms = (now_ns() - begin_ns) * 1e-6;
  hash_ = walk.hash;
  return {collision_ms, walk.pairs, walk.contacts};
}

Program::Work DropInWorld::step() {
  move();
  return collide(&near);
}

Program::Work DropInWorld::compared_step() {
  move();
  return collide(&near_hashed);
}

void DropInWorld::append_state(std::vector<dReal>& state) const {
  // Sixteen bits are a whole number in either precision.
  for (unsigned shift = 0; shift < 64; shift += 16) {
    state.push_back(static_cast<dReal>(hash_ >> shift & 0xFFFF));
  }
}

}  // namespace harpoon::bench
