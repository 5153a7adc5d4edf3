// A controller and a sensor that fail on the last robot of a world, which is not on rank 0, and a controller that waits
// for a signal.
#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <thread>

#include "base/interrupt.h"
#include "maze/controllers.h"
#include "run/plugin.h"

namespace {

struct FailingAtTheEnd : robosim::Controller {
  void step(robosim::Robot& robot) override {
    if (robot.name() == robot.robots().back() && robot.stepNumber() == 5) throw std::runtime_error("lost the flock");
  }
};

/// Measures nothing, and fails in step 5 of the world's last robot.
struct FailingSensor : robosim::Sensor {
  FailingSensor() {
    info_.kind = robosim::SensorKind::values;
    info_.label = "failing_sensor";
    info_.quantities = {{"current", "A"}};
  }
  const robosim::SensorInfo& info() const override { return info_; }
  double robotReach(double) const override { return 0; }
  void sense(const robosim::Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<robosim::Readings> readings) const override {
    for (const auto robot : robots) {
      if (robot + 1 == now.world_from_robot.size() && now.time.step == 5) throw std::runtime_error("lost the current");
      readings[robot].measurements[slot] = robosim::Values{{std::nan("")}};
    }
  }
  robosim::SensorInfo info_;
};

/// A random walk. Where the environment has ROBOSIM_TEST_WAITS, its first step ends only after a signal that ends the
/// program.
struct WaitingWalk : robosim::Controller {
  explicit WaitingWalk(const robosim::ControllerSetup& setup)
      : walk_(robosim::controllers().make("random_walk", setup)) {}
  void step(robosim::Robot& robot) override {
    const bool waits = std::getenv("ROBOSIM_TEST_WAITS") != nullptr;
    while (waits && robosim::Interrupt::signal() == 0) std::this_thread::yield();
    walk_->step(robot);
  }
  bool hasDrawnRandomNumbers() const override { return walk_->hasDrawnRandomNumbers(); }
  std::unique_ptr<robosim::Controller> walk_;
};

}  // namespace

ROBOSIM_PLUGIN(registry) {
  registry.controllers.add(
      {"failing_at_the_end", "Throws an exception in step 5 of the last robot.", {}, {}, [](const auto&, const auto&) {
         return std::make_unique<FailingAtTheEnd>();
       }});
  registry.controllers.add({"waiting_walk",
                            "Walks at random, and waits for a signal if asked to.",
                            robosim::controllers().typeOf("random_walk").needs,
                            {},
                            [](const auto& setup, const auto&) { return std::make_unique<WaitingWalk>(setup); }});
  registry.sensors.push_back({"failing_sensor", "Measures nothing, and throws an exception in step 5.", false,
                              [](robosim::XmlReader&, const robosim::Mount&) -> std::unique_ptr<robosim::Sensor> {
                                return std::make_unique<FailingSensor>();
                              },
                              nullptr});
}
