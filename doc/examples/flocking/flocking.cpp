// Robots with sonar align with the wind, keep a distance to near objects, and stay together: each turns towards objects
// at a medium distance, which in the open are other robots.
#include <algorithm>
#include <cmath>
#include <memory>
#include <variant>

#include "types.h"

namespace {

struct Options {
  double cohesion;
  double separation;
  double radius_m;
  double speed_mps;
};

class Flocking : public robosim::Controller {
 public:
  explicit Flocking(const Options& options) : options_(options) {}

  void step(robosim::Robot& robot) override {
    double left = 0;  // weighted sum of directions, in the robot's frame
    double nearest_m = options_.radius_m;
    for (const robosim::Echo& echo : robot.sonar()) {
      if (echo.range_m >= options_.radius_m) continue;
      const double distance_m = std::max(0.05, static_cast<double>(echo.range_m));
      const bool is_near = distance_m < options_.radius_m / 2;
      const double weight = is_near ? -options_.separation / distance_m : options_.cohesion / distance_m;
      left += weight * echo.point_m.y / distance_m;
      if (echo.point_m.x > 0) nearest_m = std::min(nearest_m, distance_m);
    }
    const double slowed = std::clamp(2 * nearest_m / options_.radius_m - 0.3, 0.0, 1.0);
    robot.drive(options_.speed_mps * slowed, std::clamp(left + windTurn(robot) + (slowed == 0 ? 0.8 : 0), -1.0, 1.0));
  }

  std::unique_ptr<robosim::Controller> clone() const override { return std::make_unique<Flocking>(*this); }

 private:
  /// Turning rate [rad/s] with the wind: the second quantity of the anemometer is the direction of its flow [degrees].
  static double windTurn(const robosim::Robot& robot) {
    const robosim::Measurement* wind = robot.measurement(robosim::SensorKind::values);
    if (!wind) return 0;
    const double direction_deg = std::get<robosim::Values>(*wind).values.at(1);
    return 0.3 * direction_deg / 180;
  }

  Options options_;
};

}  // namespace

robosim::ControllerType flockingType() {
  return {
      "flocking",
      "Drives with the wind, close to other robots but not into them.",
      {robosim::SensorKind::sonar},
      {{"cohesion", 0.1, 0, 10, "", "strength of turning towards what is farther than half the radius"},
       {"separation", 0.3, 0, 10, "", "strength of turning away from what is nearer than that"},
       {"radius_m", 1.5, 0.1, 10, "m", "range within which objects matter"},
       {"speed_mps", 0.4, 0, 2, "m/s", "speed without an object ahead"}},
      [](const robosim::ControllerSetup&, const robosim::ParameterValues& p) -> std::unique_ptr<robosim::Controller> {
        return std::make_unique<Flocking>(Options{p["cohesion"], p["separation"], p["radius_m"], p["speed_mps"]});
      }};
}
