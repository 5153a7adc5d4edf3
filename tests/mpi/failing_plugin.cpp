// A controller and a sensor that fail on the last robot of a world, which is not on rank 0.
#include <cmath>
#include <memory>
#include <stdexcept>

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

}  // namespace

ROBOSIM_PLUGIN(registry) {
  registry.controllers.add(
      {"failing_at_the_end", "Throws an exception in step 5 of the last robot.", {}, {}, [](const auto&, const auto&) {
         return std::make_unique<FailingAtTheEnd>();
       }});
  registry.sensors.push_back({"failing_sensor", "Measures nothing, and throws an exception in step 5.", false,
                              [](robosim::XmlReader&, const robosim::Mount&) -> std::unique_ptr<robosim::Sensor> {
                                return std::make_unique<FailingSensor>();
                              },
                              nullptr});
}
