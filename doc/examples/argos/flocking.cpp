#include <algorithm>
#include <memory>
#include <variant>

#include "footbot.h"
#include "types.h"

namespace {

constexpr double kRed = 0xFF0000;

/// Drives to the light, at a distance from the other robots, whose red LEDs the omnidirectional camera sees.
class Flocking : public robosim::Controller {
 public:
  Flocking(double target_m, double gain, double exponent, double speed_max_mps)
      : target_m_(target_m),
        gain_(gain),
        exponent_(exponent),
        speed_max_mps_(speed_max_mps),
        steering_(speed_max_mps) {}

  void step(robosim::Robot& robot) override {
    robot.setLeds({1, 0, 0});
    steering_.follow(towardsLight(robot) * (0.25 * speed_max_mps_) + awayFromNeighbours(robot), robot);
  }

  std::unique_ptr<robosim::Controller> clone() const override { return std::make_unique<Flocking>(*this); }

 private:
  /// Mean over the robots in sight.
  Vector awayFromNeighbours(const robosim::Robot& robot) const {
    Vector sum;
    int seen = 0;
    const auto& blobs = std::get<robosim::Values>(*robot.measurement("omni_camera")).values;
    for (std::size_t i = 0; i + 2 < blobs.size(); i += 3) {
      const double color = blobs[i], range_m = blobs[i + 1], bearing_rad = blobs[i + 2];
      if (color != kRed || range_m >= 1.8 * target_m_) continue;  // farther ones are behind others
      sum = sum + Vector::polar(lennardJones(range_m), bearing_rad);
      ++seen;
    }
    if (seen == 0) return {};
    const Vector mean = sum * (1.0 / seen);
    return mean.length() > speed_max_mps_ ? mean.unit() * speed_max_mps_ : mean;
  }

  /// The force of a generalised Lennard-Jones potential: negative, which repels, at less than the target distance.
  double lennardJones(double range_m) const {
    const double ratio = std::pow(target_m_ / range_m, exponent_);
    return -gain_ / range_m * (ratio * ratio - ratio);
  }

  double target_m_, gain_, exponent_, speed_max_mps_;
  Steering steering_;
};

}  // namespace

robosim::ControllerType argosFlockingType() {
  return {
      "argos_flocking",
      "Drives to the light, at a distance from robots with red LEDs.",
      {robosim::SensorKind::values},
      {{"target_m", 0.75, 0.1, 10, "m", "distance to the neighbours"},
       {"gain", 0.1, 0, 100, "m²/s", "strength of the potential"},
       {"exponent", 2, 1, 10, "", "of the potential"},
       {"speed_mps", 0.1, 0, 0.3, "m/s", "largest speed of a wheel"}},
      [](const robosim::ControllerSetup&, const robosim::ParameterValues& p) -> std::unique_ptr<robosim::Controller> {
        return std::make_unique<Flocking>(p["target_m"], p["gain"], p["exponent"], p["speed_mps"]);
      }};
}
