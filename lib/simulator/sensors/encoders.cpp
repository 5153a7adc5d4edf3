#include "sensors/encoders.h"

#include "sensors/registry.h"
#include "sensors/wheel_errors.h"

namespace robosim {
namespace {

class Encoders : public Sensor {
 public:
  Encoders(const WheelErrors& wheels, double wheel_radius_m, SensorInfo info)
      : wheels_(wheels), wheel_radius_m_(wheel_radius_m), info_(std::move(info)) {}
  const SensorInfo& info() const override { return info_; }
  double robotReach(double) const override { return 0; }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      const Motion motion = wheels_.measured(now.last_motion[robot], now.blocked(robot), now.time.period_s);
      const double aside_m = motion.turn_rad * wheels_.wheelbase_m / 2;
      const double left_rad = (motion.length_m - aside_m) / wheel_radius_m_;
      const double right_rad = (motion.length_m + aside_m) / wheel_radius_m_;
      auto& values = std::get<Values>(readings[robot].measurements[slot]).values;
      values = {values[0] + left_rad, values[1] + right_rad, left_rad / now.time.period_s,
                right_rad / now.time.period_s};
    }
  }

 private:
  WheelErrors wheels_;
  double wheel_radius_m_;
  SensorInfo info_;
};

}  // namespace

std::unique_ptr<Sensor> readEncoders(XmlReader& reader, const Mount& mount) {
  SensorInfo info;
  info.kind = SensorKind::values;
  info.label = reader.word("label", "encoders");
  info.quantities = {{"left", "rad"}, {"right", "rad"}, {"left_speed", "rad/s"}, {"right_speed", "rad/s"}};
  constexpr double kPioneerWheel_m = 0.0975;  // Pioneer 3 Operations Manual, appendix A: wheels of 195 mm
  const double wheel_radius_m = reader.number("wheel_radius_m", Bounds::positive(100), kPioneerWheel_m);
  WheelErrors wheels = WheelErrors::ofRobot(mount.robot_radius_m, mount.drive);
  wheels.wheelbase_m = reader.number("wheelbase_m", Bounds::positive(100), wheels.wheelbase_m);
  if (mount.drive.kind == DriveKind::omni || mount.drive.kind == DriveKind::car) {
    reader.error("measures two driven wheels or tracks, which a robot with this <drive> does not have; leave it out");
  }
  if (auto noise = reader.child("noise")) {
    wheels.readErrors(*noise);
    noise->finish();
  }
  return std::make_unique<Encoders>(wheels, wheel_radius_m, std::move(info));
}

}  // namespace robosim
