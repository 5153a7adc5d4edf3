#include "sensors/imu.h"

#include <cmath>

#include "base/angle_units.h"
#include "base/portable_math.h"
#include "hardware/inertial_reading.h"

namespace robosim {
namespace {

constexpr double kGravity_mps2 = 9.80665;  // standard gravity (CGPM 1901)

/// Standard deviations.
struct ImuErrors {
  double gyro_noise = 0;  ///< [rad/s / √Hz]
  double gyro_bias_radps = 0;
  double gyro_scale = 0;   ///< share of the rate
  double accel_noise = 0;  ///< [m/s² / √Hz]
  double accel_bias_mps2 = 0;
};

class Imu : public Sensor {
 public:
  Imu(bool is_noisy, const ImuErrors& errors, SensorInfo info)
      : is_noisy_(is_noisy), errors_(errors), info_(std::move(info)) {}
  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return is_noisy_; }
  bool usesFormerMotion() const override { return true; }
  double robotReach(double) const override { return 0; }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      const Motion& motion = now.last_motion[robot];
      const bool is_first = now.time.step == 0;
      const Motion& former = is_first || now.former_motion.empty() ? motion : now.former_motion[robot];
      InertialReading reading = exact(motion, former, now.time.period_s);
      if (is_noisy_) addErrors(now, robot, slot, reading);
      std::get<Values>(readings[robot].measurements[slot]) = reading.values();
    }
  }

 private:
  /// Speeds are those in the middle of each step, in which the robot's heading is half a turn short of that at its end.
  static InertialReading exact(const Motion& motion, const Motion& former, double period_s) {
    const auto between = portable::sincos((former.turn_rad + motion.turn_rad) / 2);
    const double ahead_m = motion.length_m - (former.length_m * between.cos + former.lateral_m * between.sin);
    const double left_m = motion.lateral_m - (former.lateral_m * between.cos - former.length_m * between.sin);
    const double square_s2 = period_s * period_s;
    return {motion.turn_rad / period_s, ahead_m / square_s2, left_m / square_s2, kGravity_mps2};
  }

  void addErrors(const Snapshot& now, std::uint32_t robot, std::size_t slot, InertialReading& reading) const {
    // What is constant in the run is drawn from the streams of step 0 of a stream of its own.
    constexpr std::uint32_t kConstantStream = 1u << 20;
    Rng constant(now.seed, RandomPurpose::sensor_noise, robot, static_cast<std::uint32_t>(slot) | kConstantStream, 0);
    Rng white = now.noise(robot, slot);
    const double noise = 1 / std::sqrt(2 * now.time.period_s);
    reading.turn_radps *= 1 + errors_.gyro_scale * constant.gaussian();
    reading.turn_radps += errors_.gyro_bias_radps * constant.gaussian() + errors_.gyro_noise * noise * white.gaussian();
    for (double* accel_mps2 : {&reading.ahead_mps2, &reading.left_mps2, &reading.up_mps2}) {
      *accel_mps2 += errors_.accel_bias_mps2 * constant.gaussian() + errors_.accel_noise * noise * white.gaussian();
    }
  }

  bool is_noisy_;
  ImuErrors errors_;
  SensorInfo info_;
};

}  // namespace

std::unique_ptr<Sensor> readImu(XmlReader& reader, const Mount&) {
  SensorInfo info;
  info.kind = SensorKind::values;
  info.label = reader.word("label", "imu");
  info.quantities = InertialReading::quantities();
  ImuErrors errors;
  auto noise = reader.child("noise");
  if (noise) {
    // Defaults: Bosch BMI160 data sheet (BST-BMI160-DS000): 0.007 °/s/√Hz, ±3 °/s, sensitivity ±3 %; 180 µg/√Hz, ±40
    // mg.
    errors.gyro_noise = noise->angle("gyro_noise_deg_per_s_per_sqrt_hz", {0, 100}, 0.007 * kRadPerDeg);
    errors.gyro_bias_radps = noise->angle("gyro_bias_deg_per_s", {0, 100}, 3 * kRadPerDeg);
    errors.gyro_scale = noise->number("gyro_scale", {0, 1}, 0.03);
    errors.accel_noise = noise->number("accel_noise_mps2_per_sqrt_hz", {0, 100}, 180e-6 * kGravity_mps2);
    errors.accel_bias_mps2 = noise->number("accel_bias_mps2", {0, 100}, 0.04 * kGravity_mps2);
    noise->finish();
  }
  return std::make_unique<Imu>(noise.has_value(), errors, std::move(info));
}

}  // namespace robosim
