#include "sensors/odometry.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/wrapped_angle.h"
#include "geometry/shapes/chord_batch.h"

namespace robosim {
namespace {

/// Adds a motion along an arc of constant curvature.
/// @param chord of the arc, odometry frame
void advance(Odometry& odometry, const Motion& motion, const ChordBatch::Chord& chord, double period_s) {
  auto& pose = odometry.odom_from_robot;
  const double length_m = motion.length_m * chord.per_arc;
  const auto [sin, cos] = chord.direction;
  pose.x += length_m * cos;
  pose.y += length_m * sin;
  if (motion.lateral_m != 0) {
    const double aside_m = motion.lateral_m * chord.per_arc;
    pose.x -= aside_m * sin;
    pose.y += aside_m * cos;
  }
  pose.phi = wrappedAngle(pose.phi + motion.turn_rad);
  odometry.speed_mps = motion.length_m / period_s;
  odometry.turn_radps = motion.turn_rad / period_s;
  odometry.lateral_mps = motion.lateral_m / period_s;
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
    if (options_.noise.on) {
      for (const auto robot : robots) {
        senseWithNoise(now, robot, slot, std::get<Odometry>(readings[robot].measurements[slot]));
      }
      return;
    }
    for (std::size_t begin = 0; begin < robots.size(); begin += ChordBatch::kCapacity) {
      const std::size_t count = std::min(robots.size() - begin, ChordBatch::kCapacity);
      senseTogether(now, robots.subspan(begin, count), slot, readings);
    }
  }

 private:
  /// @param robots at most ChordBatch::kCapacity
  void senseTogether(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
                     std::span<Readings> readings) const {
    ChordBatch arcs;
    std::array<Odometry*, ChordBatch::kCapacity> odometries;
    for (std::size_t k = 0; k < robots.size(); ++k) {
      odometries[k] = &std::get<Odometry>(readings[robots[k]].measurements[slot]);
      arcs.add(odometries[k]->odom_from_robot.phi, now.last_motion[robots[k]].turn_rad / 2);
    }
    arcs.compute();
    for (std::size_t k = 0; k < robots.size(); ++k) {
      advance(*odometries[k], now.last_motion[robots[k]], arcs[k], now.time.period_s);
    }
  }

  void senseWithNoise(const Snapshot& now, std::uint32_t robot, std::size_t slot, Odometry& odometry) const {
    Motion motion = now.last_motion[robot];
    if (has_wheel_errors_) motion = options_.wheels.measured(motion, now.blocked(robot), now.time.period_s);
    motion = withNoise(motion, now.noise(robot, slot));
    ChordBatch arc;
    arc.add(odometry.odom_from_robot.phi, motion.turn_rad / 2);
    arc.compute();
    advance(odometry, motion, arc[0], now.time.period_s);
  }

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
