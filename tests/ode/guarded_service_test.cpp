#include "ode/guarded_service.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <new>
#include <vector>

#include "ode/frame.hpp"

namespace harpoon::ode {
namespace {

int callbacks = 0, stock_calls = 0;

void near(void*, dxGeom*, dxGeom*) {
  ++callbacks;
}

LibodeOf<double> counting_libode() {
  LibodeOf<double> ode;
  ode.space_collide = [](dxSpace*, void* data, NearCallback* callback) {
    ++stock_calls;
    callback(data, nullptr, nullptr);
  };
  ode.space_collide2 = [](dxGeom*, dxGeom*, void* data, NearCallback* callback) {
    ++stock_calls;
    callback(data, nullptr, nullptr);
  };
  return ode;
}

/// An engine that runs out of memory in everything it is asked or told.
class FailingEngine final : public Engine {
 public:
  explicit FailingEngine(int& losses) : losses_(losses) {}
  bool calls_back = false;  ///< before it fails

  void space_collide(dxSpace*, void* data, NearCallback* callback) override {
    fail_in_call(data, callback);
  }
  void space_collide2(dxGeom*, dxGeom*, void* data, NearCallback* callback) override {
    fail_in_call(data, callback);
  }
  int collide(dxGeom*, dxGeom*, int, void*, int) override { return 0; }
  void moved(dxGeom*) override {}
  void changing(dxGeom*, Change) override { fail(); }
  void filters_changed(dxGeom*) override { fail(); }
  void toggled(dxGeom*) override { fail(); }
  void added(dxSpace*) override { fail(); }
  void removed(dxSpace*, dxGeom*) override { fail(); }
  void destroying(dxGeom*) override { fail(); }
  void levels_changed(dxSpace*) override { fail(); }
  void sap_created(dxSpace*, int) override { fail(); }
  void class_created(int, AabbTest*) override { fail(); }
  void collider_overridden(int, int) override { fail(); }
  void closed() override { fail(); }
  void lost_track() noexcept override { ++losses_; }
  [[nodiscard]] const Statistics& statistics() const override { return statistics_; }
  [[nodiscard]] std::string report() const override { fail(); }

 private:
  [[noreturn]] static void fail() { throw std::bad_alloc(); }
  void fail_in_call(void* data, NearCallback* callback) const {
    if (calls_back) {
      ++walks_begun;
      callback(data, nullptr, nullptr);
    }
    fail();
  }

  int& losses_;
  Statistics statistics_;
};

class GuardedServiceTest : public ::testing::Test {
 protected:
  GuardedServiceTest() {
    callbacks = stock_calls = 0;
    auto made = std::make_unique<FailingEngine>(losses_);
    engine_ = made.get();
    service_.engine_is(std::move(made), true);
  }
  void collide(int arguments) {
    if (arguments == 1) return service_.space_collide(nullptr, nullptr, &near);
    service_.space_collide2(nullptr, nullptr, nullptr, &near);
  }

  int losses_ = 0;
  FailingEngine* engine_ = nullptr;
  GuardedService<double> service_{counting_libode(), ""};
};

TEST_F(GuardedServiceTest, BeforeTheFirstCallbackLibodeTakesOver) {
  for (const int arguments : {1, 2}) {
    collide(arguments);
    EXPECT_EQ(stock_calls, arguments);
    EXPECT_EQ(callbacks, arguments);
  }
}

/// As a callback of the program's own that runs out of memory: nothing is called twice.
TEST_F(GuardedServiceTest, WhatIsThrownAfterwardsIsTheCallers) {
  engine_->calls_back = true;
  for (const int arguments : {1, 2}) {
    EXPECT_THROW(collide(arguments), std::bad_alloc);
    EXPECT_EQ(stock_calls, 0);
    EXPECT_EQ(callbacks, arguments);
  }
}

TEST_F(GuardedServiceTest, AnEventThatCannotBeNotedMakesEverythingStale) {
  const std::vector<std::function<void(Service&)>> events = {
      [](Service& s) { s.changing(nullptr, Change::filter); },
      [](Service& s) { s.filters_changed(nullptr); },
      [](Service& s) { s.toggled(nullptr); },
      [](Service& s) { s.added(nullptr); },
      [](Service& s) { s.removed(nullptr, nullptr); },
      [](Service& s) { s.destroying(nullptr); },
      [](Service& s) { s.levels_changed(nullptr); },
      [](Service& s) { s.sap_created(nullptr, 0); },
      [](Service& s) { s.class_created(0, nullptr); },
      [](Service& s) { s.collider_overridden(0, 0); },
      [](Service& s) { s.closed(); },
      [](Service& s) { s.report(); },
  };
  for (std::size_t k = 0; k < events.size(); ++k) {
    events[k](service_);
    EXPECT_EQ(losses_, static_cast<int>(k) + 1);
  }
}

TEST(GuardedService, WithoutAnEngineEveryCallIsLibodes) {
  callbacks = stock_calls = 0;
  GuardedService<double> service(counting_libode(), "");
  service.space_collide(nullptr, nullptr, &near);
  service.space_collide2(nullptr, nullptr, nullptr, &near);
  service.added(nullptr);
  EXPECT_EQ(stock_calls, 2);
}

}  // namespace
}  // namespace harpoon::ode
