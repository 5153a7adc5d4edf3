#include <memory>

#include "footbot.h"
#include "types.h"

namespace {

/// Drives straight on, and turns away from what the proximity sensors see.
class Diffusion : public robosim::Controller {
 public:
  Diffusion(double speed_mps, double straight_rad, double delta)
      : speed_mps_(speed_mps), straight_rad_(straight_rad), delta_(delta) {}

  void step(robosim::Robot& robot) override {
    const Vector near = proximity(robot) * (1.0 / 24);
    if (std::abs(near.angle()) <= straight_rad_ && near.length() < delta_) {
      driveWheels(robot, speed_mps_, speed_mps_);
    } else if (near.angle() > 0) {
      driveWheels(robot, speed_mps_, 0);  // something on the left: to the right
    } else {
      driveWheels(robot, 0, speed_mps_);
    }
  }

  std::unique_ptr<robosim::Controller> clone() const override { return std::make_unique<Diffusion>(*this); }

 private:
  double speed_mps_, straight_rad_, delta_;
};

}  // namespace

robosim::ControllerType argosDiffusionType() {
  return {
      "argos_diffusion",
      "Drives straight on, and turns away from what its proximity sensors see.",
      {robosim::SensorKind::infrared},
      {{"speed_mps", 0.05, 0, 0.3, "m/s", "of a wheel"},
       {"alpha_deg", 7.5, 0, 180, "degrees", "straight on, if what is near is within this angle of the heading"},
       {"delta", 0.1, 0, 1, "", "and its mean proximity is below this"}},
      [](const robosim::ControllerSetup&, const robosim::ParameterValues& p) -> std::unique_ptr<robosim::Controller> {
        return std::make_unique<Diffusion>(p["speed_mps"], p["alpha_deg"] * M_PI / 180, p["delta"]);
      }};
}
