#include "sensors/odometry.h"

#include <cmath>

#include "base/portable_math.h"
#include "base/wrapped_angle.h"

namespace robosim {
namespace {

/// The pose after an arc of constant curvature.
mrpt::math::TPose2D afterArc(const mrpt::math::TPose2D& from, const Motion& motion) {
  const double half = motion.turn_rad / 2;
  const double chord_by_arc = half == 0 ? 1 : portable::sin(half) / half;
  const double chord = motion.length_m * chord_by_arc;
  const auto [sin, cos] = portable::sincos(from.phi + half);
  mrpt::math::TPose2D to{from.x + chord * cos, from.y + chord * sin, wrappedAngle(from.phi + motion.turn_rad)};
  if (motion.lateral_m != 0) {
    const double aside = motion.lateral_m * chord_by_arc;
    to.x -= aside * sin;
    to.y += aside * cos;
  }
  return to;
}

class WheelOdometry : public Sensor {
 public:
  explicit WheelOdometry(const OdometryOptions& options)
      : options_(options), has_wheel_errors_(!options.wheels.isNone()) {
    info_.kind = SensorKind::odometry;
    info_.label = options.label;
  }

  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return options_.noise.on; }
  double robotReach(double) const override { return 0; }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      auto& odometry = std::get<Odometry>(readings[robot].measurements[slot]);
      Motion measured = now.last_motion[robot];
      if (options_.noise.on) {
        if (has_wheel_errors_) measured = options_.wheels.measured(measured, now.blocked(robot), now.time.period_s);
        measured = withNoise(measured, now.noise(robot, slot));
      }
      odometry.odom_from_robot = afterArc(odometry.odom_from_robot, measured);
      odometry.speed_mps = measured.length_m / now.time.period_s;
      odometry.turn_radps = measured.turn_rad / now.time.period_s;
      odometry.lateral_mps = measured.lateral_m / now.time.period_s;
    }
  }

 private:
  Motion withNoise(const Motion& true_motion, Rng rng) const {
    const auto& noise = options_.noise;
    const double root_m = std::sqrt(std::abs(true_motion.length_m));
    const double root_rad = std::sqrt(std::abs(true_motion.turn_rad));
    Motion measured = true_motion;
    measured.length_m += noise.length_std_per_sqrt_m * root_m * rng.gaussian();
    measured.turn_rad += noise.turn_std_per_sqrt_rad * root_rad * rng.gaussian();
    measured.turn_rad += noise.drift_std_per_sqrt_m * root_m * rng.gaussian();
    if (true_motion.lateral_m != 0) {
      const double root_lateral_m = std::sqrt(std::abs(true_motion.lateral_m));
      measured.lateral_m += noise.length_std_per_sqrt_m * root_lateral_m * rng.gaussian();
      measured.turn_rad += noise.drift_std_per_sqrt_m * root_lateral_m * rng.gaussian();
    }
    return measured;
  }

  OdometryOptions options_;
  bool has_wheel_errors_;
  SensorInfo info_;
};

}  // namespace

OdometryOptions OdometryOptions::read(XmlReader& reader, const Mount& mount) {
  OdometryOptions o;
  o.label = reader.word("label", o.label);
  if (auto element = reader.child("noise")) {
    o.noise.on = true;
    const auto read = [&](const char* name, double& value) {
      value = element->number(name, Bounds::notNegative(10), value);
    };
    read("length_std_per_sqrt_m", o.noise.length_std_per_sqrt_m);
    read("turn_std_per_sqrt_rad", o.noise.turn_std_per_sqrt_rad);
    read("drift_std_per_sqrt_m", o.noise.drift_std_per_sqrt_m);
    o.wheels = WheelErrors::read(*element, mount.robot_radius_m, mount.drive);
    element->finish();
  }
  return o;
}

std::unique_ptr<Sensor> makeOdometry(const OdometryOptions& options) {
  return std::make_unique<WheelOdometry>(options);
}

}  // namespace robosim
