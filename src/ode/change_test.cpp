#include "ode/change_test.hpp"

#include <atomic>

#include "ode/watch.hpp"

namespace harpoon::ode {
namespace {

/// Remembers of which geoms and spaces events came from this thread.
class ChangeListener final : public Engine {
 public:
  enum class Event { none, moved, filters, toggled, added, removed, destroying, levels, sap };

  /// Whom it listens to.
  void is_of_this_thread() { thread_ = this_thread(); }
  /// Forgets what was heard.
  void listen_for(Event event, const void* object) {
    event_ = event;
    object_ = object;
    heard_ = false;
  }
  [[nodiscard]] bool heard() const { return heard_; }

  void space_collide(dxSpace*, void*, NearCallback*) override {}
  void space_collide2(dxGeom*, dxGeom*, void*, NearCallback*) override {}
  int collide(dxGeom*, dxGeom*, int, void*, int) override { return 0; }
  void moved(dxGeom* geom) override { hear(Event::moved, geom); }
  void filters_changed(dxGeom* geom) override { hear(Event::filters, geom); }
  void changing(dxGeom*, Change) override {}
  void toggled(dxGeom* geom) override { hear(Event::toggled, geom); }
  void added(dxSpace* space) override { hear(Event::added, space); }
  void removed(dxSpace* space, dxGeom*) override { hear(Event::removed, space); }
  void destroying(dxGeom* geom) override { hear(Event::destroying, geom); }
  void levels_changed(dxSpace* space) override { hear(Event::levels, space); }
  void sap_created(dxSpace* space, int) override {
    // What it is called is known only afterwards.
    if (is_own_thread() && event_ == Event::sap) object_ = space;
    hear(Event::sap, space);
  }
  void class_created(int, AabbTest*) override {}
  void collider_overridden(int, int) override {}
  void closed() override {}
  void lost_track() noexcept override {}
  [[nodiscard]] const Statistics& statistics() const override { return statistics_; }
  [[nodiscard]] std::string report() const override { return {}; }

 private:
  static const void* this_thread() {
    static thread_local char token = 0;
    return &token;
  }
  [[nodiscard]] bool is_own_thread() const { return this_thread() == thread_; }
  void hear(Event event, const void* object) {
    if (is_own_thread() && event == event_ && object == object_) heard_ = true;
  }

  std::atomic<const void*> thread_{nullptr};
  Event event_ = Event::none;
  const void* object_ = nullptr;
  bool heard_ = false;
  Statistics statistics_;
};

struct dxWorld;

/// libode's functions that change something. Those that programs call are taken as programs reach
/// them where that makes a difference: whoever stands in front must hear of them.
template <class Real>
class ChangeTest {
 public:
  ChangeTest(const ServiceRequest& request, ChangeListener& listener)
      : request_(request), listener_(listener) {}

  std::string run() {
    make_spaces();
    test_geoms();
    test_bodies();
    destroy_spaces();
    return missing_ == nullptr ? std::string() : std::string(missing_);
  }

 private:
  using Event = ChangeListener::Event;

  /// Calls libode's function of that name. Where there is none nothing can be said of it. After the
  /// first change that was not heard nothing more is tried.
  template <class Value = void, class... Arguments>
  Value call(const char* name, Arguments... arguments) {
    return call_found<Value>(request_.find(request_.libode, name), name, arguments...);
  }
  /// The same as programs reach it.
  template <class Value = void, class... Arguments>
  Value call_in_front(const char* name, Arguments... arguments) {
    const bool is_there = request_.find(request_.libode, name) != nullptr;
    return call_found<Value>(is_there ? request_.find_in_front(name) : nullptr, name, arguments...);
  }
  template <class Value, class... Arguments>
  Value call_found(void* function, const char* name, Arguments... arguments) {
    if (missing_ != nullptr && !clears_up_) return Value();
    if (function != nullptr) {
      return reinterpret_cast<Value (*)(Arguments...)>(function)(arguments...);
    }
    note_missing(name);
    return Value();
  }
  void note_missing(const char* name) {
    if (missing_ == nullptr) missing_ = name;
  }
  /// What follows is to be heard as that event of that object.
  template <class Object>
  void expect(Event event, const Object* object) {
    listener_.listen_for(event, object);
  }
  void check(const char* name) {
    if (!listener_.heard()) note_missing(name);
  }
  template <class... Arguments>
  void move(dxGeom* geom, const char* name, Arguments... arguments) {
    expect(Event::moved, geom);
    call(name, arguments...);
    check(name);
  }
  template <class Object, class... Arguments>
  void change(Event event, const Object* object, const char* name, Arguments... arguments) {
    expect(event, object);
    call_in_front(name, arguments...);
    check(name);
  }

  void make_spaces();
  void test_geoms();
  void test_bodies();
  void destroy_spaces();
  dxGeom* create(const char* name, dxSpace* space, auto... sizes) {
    expect(Event::added, space);
    auto* const geom = call<dxGeom*>(name, space, sizes...);
    check(name);
    return geom;
  }

  const ServiceRequest& request_;
  ChangeListener& listener_;
  const char* missing_ = nullptr;
  bool clears_up_ = false;
  dxSpace *outer_ = nullptr, *inner_ = nullptr, *sap_ = nullptr;
  static constexpr Real kTurn[12] = {0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0};
  static constexpr Real kQuarter[4] = {0, 1, 0, 0};
};

template <class Real>
void ChangeTest<Real>::make_spaces() {
  outer_ = call<dxSpace*>("dHashSpaceCreate", static_cast<dxSpace*>(nullptr));
  if (outer_ == nullptr) return;
  expect(Event::added, outer_);
  inner_ = call<dxSpace*>("dSimpleSpaceCreate", outer_);
  check("dSimpleSpaceCreate");
  expect(Event::sap, static_cast<dxSpace*>(nullptr));
  constexpr int kXyz = 0 | 1 << 2 | 2 << 4;
  // Within the other one, by which everybody knows which libode is meant.
  sap_ = call_in_front<dxSpace*>("dSweepAndPruneSpaceCreate", outer_, kXyz);
  check("dSweepAndPruneSpaceCreate");
  change(Event::levels, outer_, "dHashSpaceSetLevels", outer_, -3, 10);
}

template <class Real>
void ChangeTest<Real>::test_geoms() {
  const Real one = 1, two = 2, zero = 0;
  for (dxSpace* space : {inner_, sap_}) {
    if (space == nullptr) continue;
    dxGeom* const sphere = create("dCreateSphere", space, one);
    dxGeom* const box = create("dCreateBox", space, one, one, one);
    dxGeom* const capsule = create("dCreateCapsule", space, one, one);
    dxGeom* const cylinder = create("dCreateCylinder", space, one, one);
    dxGeom* const plane = create("dCreatePlane", space, zero, zero, one, zero);
    dxGeom* const ray = create("dCreateRay", space, one);
    move(sphere, "dGeomSetPosition", sphere, one, zero, zero);
    move(box, "dGeomSetRotation", box, &kTurn[0]);
    move(box, "dGeomSetQuaternion", box, &kQuarter[0]);
    move(sphere, "dGeomSphereSetRadius", sphere, two);
    move(box, "dGeomBoxSetLengths", box, two, two, two);
    move(capsule, "dGeomCapsuleSetParams", capsule, two, two);
    move(cylinder, "dGeomCylinderSetParams", cylinder, two, two);
    move(plane, "dGeomPlaneSetParams", plane, zero, one, zero, zero);
    move(ray, "dGeomRaySetLength", ray, two);
    move(ray, "dGeomRaySet", ray, zero, zero, zero, zero, zero, one);
    change(Event::toggled, sphere, "dGeomDisable", sphere);
    change(Event::toggled, sphere, "dGeomEnable", sphere);
    change(Event::filters, sphere, "dGeomSetCategoryBits", sphere, 3UL);
    change(Event::filters, sphere, "dGeomSetCollideBits", sphere, 3UL);
    change(Event::removed, space, "dSpaceRemove", space, sphere);
    change(Event::added, space, "dSpaceAdd", space, sphere);
    expect(Event::removed, space);
    call("dGeomDestroy", sphere);
    check("dGeomDestroy");
    change(Event::destroying, box, "dGeomDestroy", box);
  }
}

template <class Real>
void ChangeTest<Real>::test_bodies() {
  const Real one = 1, zero = 0;
  auto* const world = call<dxWorld*>("dWorldCreate");
  if (world == nullptr) return;
  auto* const body = call<dxBody*>("dBodyCreate", world);
  dxGeom* const geom = create("dCreateSphere", inner_, one);
  if (body != nullptr && geom != nullptr) {
    change(Event::filters, geom, "dGeomSetBody", geom, body);
    move(geom, "dGeomSetBody", geom, body);
    move(geom, "dBodySetPosition", body, one, zero, zero);
    move(geom, "dBodySetRotation", body, &kTurn[0]);
    move(geom, "dBodySetQuaternion", body, &kQuarter[0]);
    move(geom, "dGeomSetOffsetPosition", geom, one, zero, zero);
    move(geom, "dGeomSetOffsetRotation", geom, &kTurn[0]);
    move(geom, "dGeomSetOffsetQuaternion", geom, &kQuarter[0]);
    move(geom, "dGeomSetOffsetWorldPosition", geom, one, zero, zero);
    move(geom, "dGeomSetOffsetWorldRotation", geom, &kTurn[0]);
    move(geom, "dGeomSetOffsetWorldQuaternion", geom, &kQuarter[0]);
    move(geom, "dGeomClearOffset", geom);
    call("dBodySetLinearVel", body, one, zero, zero);
    // A step needs what dInitODE makes.
    if (!request_.is_initialised) note_missing("dWorldStep");
    move(geom, "dWorldStep", world, one);
    expect(Event::filters, geom);
    call("dBodyDestroy", body);
    check("dBodyDestroy");
  }
  clears_up_ = true;
  call("dWorldDestroy", world);
}

template <class Real>
void ChangeTest<Real>::destroy_spaces() {
  if (inner_ != nullptr && missing_ == nullptr) {
    expect(Event::removed, outer_);
    call("dSpaceDestroy", inner_);
    check("dSpaceDestroy");
    inner_ = call<dxSpace*>("dSimpleSpaceCreate", outer_);
  }
  clears_up_ = true;
  if (outer_ == nullptr) return;
  // A space within goes with the one around it.
  expect(Event::destroying, inner_);
  call("dSpaceDestroy", outer_);
  check("dSpaceDestroy");
}

}  // namespace

template <class Real>
std::string unheard_change(const ServiceRequest& request, GuardedService<Real>& service) {
  // Another thread may call it even later.
  static ChangeListener listeners[kMostServices];
  ChangeListener& listener = listeners[request.number];
  listener.is_of_this_thread();
  Watch& watch = watch_of(request);
  watch.engine.store(&listener, std::memory_order_release);
  service.listener_is(&listener);
  request.listen(request.libode, &service);
  watch.watch_moves();
  std::string unheard = ChangeTest<Real>(request, listener).run();
  service.listener_is(nullptr);
  watch.ignore_moves();
  return unheard;
}

template std::string unheard_change(const ServiceRequest&, GuardedService<float>&);
template std::string unheard_change(const ServiceRequest&, GuardedService<double>&);

}  // namespace harpoon::ode
