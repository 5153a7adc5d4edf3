#include "arcos/board/arcos_board.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <mrpt/math/wrap2pi.h>

#include "arcos/protocol/bumpers.h"
#include "arcos/protocol/bytes.h"
#include "arcos/protocol/command.h"
#include "base/angle_units.h"
#include "base/portable_math.h"
#include "base/portable_pose.h"
#include "hardware/inertial_reading.h"

namespace robosim {
namespace {

namespace command = arcos::command;
using arcos::Packet;
using arcos::Sip;

constexpr double kMm = 1000;
/// Stands for a maximum speed of 0, which AxisLimits reads as the hardware's [m/s, rad/s].
constexpr double kStanding = 1e-9;

/// Rounds to an integer type, clamped to its range.
template <typename Integer>
Integer rounded(double value) {
  using Limits = std::numeric_limits<Integer>;
  return static_cast<Integer>(std::clamp(std::round(value), double{Limits::min()}, double{Limits::max()}));
}

/// The low 16 bits of a length in a robot's unit.
std::uint16_t wrapped(double length_m, double unit_mm) {
  return static_cast<std::uint16_t>(static_cast<std::int64_t>(std::llround(length_m * kMm / unit_mm)));
}

}  // namespace

ArcosBoard::ArcosBoard(Robot& robot, const arcos::Parameters& parameters)
    : robot_(robot), parameters_(parameters), drive_(robot), camera_(robot) {
  startSession();
}

void ArcosBoard::startSession() {
  way_limits_ = {parameters_.speed_mmps / kMm, parameters_.accel_mmps2 / kMm, parameters_.accel_mmps2 / kMm};
  turn_limits_ = {parameters_.turn_degps * kRadPerDeg, parameters_.turn_accel_degps2 * kRadPerDeg,
                  parameters_.turn_accel_degps2 * kRadPerDeg};
  drive_.limitWay(way_limits_);
  drive_.limitTurn(turn_limits_);
  are_motors_on_ = true;
  is_stopping_ = false;
  is_sonar_on_ = true;
  bumper_stall_ = 0;
  battery_test_volts_ = 0;
  digital_out_ = 0xFF;
  camera_.startSession();
  aux_ = {};
  last_odom_from_robot_ = robot_.odometry().odom_from_robot;
  left_mm_ = right_mm_ = 0;
  zeroOdometry();
  drive_.stop();
}

void ArcosBoard::endSession() { drive_.stop(); }

void ArcosBoard::setOdometry(const mrpt::math::TPose2D& session_from_robot) {
  session_from_odom_ = portable::compose(session_from_robot, portable::inverse(robot_.odometry().odom_from_robot));
}

mrpt::math::TPose2D ArcosBoard::odometry() const {
  return portable::compose(session_from_odom_, robot_.odometry().odom_from_robot);
}

void ArcosBoard::execute(const Packet& packet) {
  if (packet.id == command::seto) {
    arcos::ByteReader pose(packet.payload);
    const double x_mm = pose.take<std::int16_t>(), y_mm = pose.take<std::int16_t>(), deg = pose.take<std::int16_t>();
    setOdometry(pose.endedEarly() ? mrpt::math::TPose2D()
                                  : mrpt::math::TPose2D(x_mm / kMm, y_mm / kMm, deg * kRadPerDeg));
    return;
  }
  if (packet.id == command::stop || packet.id == command::estop || packet.id == command::qstop) {
    drive_.stop();
    is_stopping_ = packet.id != command::stop;
    return;
  }
  if (packet.id == command::tty2) {
    if (const auto bytes = arcos::textOf(packet)) aux_.receive(camera_.receive(*bytes));
    return;
  }
  const auto number = arcos::numberOf(packet);
  if (!number) return;
  switch (packet.id) {
    case command::getaux:
      aux_.request(*number);
      break;
    case command::enable:
      if (const bool on = *number != 0; on != are_motors_on_) {
        are_motors_on_ = on;
        drive_.stop();
      }
      break;
    case command::sonar:
      is_sonar_on_ = *number != 0;
      break;
    case command::bumpstall:
      bumper_stall_ = *number;
      break;
    case command::battest:
      battery_test_volts_ = *number / 10.0;
      break;
    case command::digout:
      setOutputs(*number);
      break;
    case command::gripper:
      moveGripper(*number);
      break;
    case command::seta:
    case command::setv:
    case command::setra:
    case command::setrv:
      setLimit(packet.id, *number);
      break;
    default:
      if (are_motors_on_ && !is_stopping_) executeMotion(packet.id, *number);
  }
}

void ArcosBoard::executeMotion(std::uint8_t id, double argument) {
  switch (id) {
    case command::vel:
      return drive_.setSpeed(argument / kMm);
    case command::move:
      return drive_.moveBy(argument / kMm);
    case command::rotate:
    case command::rvel:
      return drive_.setTurn(argument * kRadPerDeg);
    case command::head:
      return drive_.turnTo(argument * kRadPerDeg - session_from_odom_.phi);
    case command::dhead:
      return drive_.turnBy(argument * kRadPerDeg);
    case command::vel2: {
      const auto wheels = static_cast<std::uint16_t>(static_cast<int>(argument));
      const double left_mmps = static_cast<std::int8_t>(wheels >> 8) * parameters_.wheel_speed_unit_mmps;
      const double right_mmps = static_cast<std::int8_t>(wheels & 0xFF) * parameters_.wheel_speed_unit_mmps;
      drive_.setSpeed((left_mmps + right_mmps) / 2 / kMm);
      drive_.setTurn((right_mmps - left_mmps) / 2 * parameters_.turn_radpmm);
      return;
    }
    default:
      return;
  }
}

void ArcosBoard::setLimit(std::uint8_t id, double argument) {
  const bool is_way = id == command::seta || id == command::setv;
  AxisLimits& limits = is_way ? way_limits_ : turn_limits_;
  const double value = std::abs(argument) * (is_way ? 1 / kMm : kRadPerDeg);
  if (id == command::setv || id == command::setrv) {
    limits.speed_max = std::max(value, kStanding);
  } else if (argument != 0) {
    (argument > 0 ? limits.accel : limits.decel) = value;
  }
  drive_.limitWay(way_limits_);
  drive_.limitTurn(turn_limits_);
}

void ArcosBoard::setOutputs(int mask_and_values) {
  const auto mask = static_cast<std::uint8_t>(mask_and_values >> 8);
  const auto values = static_cast<std::uint8_t>(mask_and_values & 0xFF);
  digital_out_ = static_cast<std::uint8_t>((digital_out_ & ~mask) | (values & mask));
}

void ArcosBoard::moveGripper(int operation) {
  using namespace arcos::gripper_operation;
  if (operation == close || operation == store) robot_.grip();
  if (operation == open || operation == deploy) robot_.release();
}

arcos::GripperPacket ArcosBoard::gripper() const {
  if (!robot_.hasGripper()) return {};
  const GripperState state = robot_.gripper();
  return {arcos::GripperPacket::kGeneralIo, {state.is_closed, state.inner_beam, state.outer_beam}};
}

std::optional<double> ArcosBoard::gyroRate() const {
  const auto& sensors = *robot_.info().sensors;
  const auto gyro = std::find_if(sensors.begin(), sensors.end(), InertialReading::isOf);
  if (gyro == sensors.end()) return std::nullopt;
  const auto& measured = robot_.readings().measurements[static_cast<std::size_t>(gyro - sensors.begin())];
  return InertialReading::from(std::get<Values>(measured)).turn_radps;
}

void ArcosBoard::update(bool is_link_alive) {
  const mrpt::math::TPose2D& odom_from_robot = robot_.odometry().odom_from_robot;
  const double turned = mrpt::math::wrapToPi(odom_from_robot.phi - last_odom_from_robot_.phi);
  const auto [sin, cos] = portable::sincos(last_odom_from_robot_.phi + turned / 2);
  const double driven_mm =
      kMm * ((odom_from_robot.x - last_odom_from_robot_.x) * cos + (odom_from_robot.y - last_odom_from_robot_.y) * sin);
  left_mm_ += driven_mm - turned / parameters_.turn_radpmm;
  right_mm_ += driven_mm + turned / parameters_.turn_radpmm;
  last_odom_from_robot_ = odom_from_robot;

  drive_.enable(are_motors_on_ && is_link_alive);
  const Odometry& motion = robot_.odometry();
  if (is_stopping_ && motion.speed_mps == 0 && motion.turn_radps == 0) is_stopping_ = false;
  drive_.update();
  if (is_stopping_) robot_.stopInEmergency();
}

double ArcosBoard::batteryVolts() const {
  return battery_test_volts_ > 0 ? battery_test_volts_ : robot_.battery().value_or(parameters_.battery_volts);
}

void ArcosBoard::addBumpers(Sip& sip) const {
  const SensorInfo* bumper = robot_.sensor(SensorKind::bumper);
  const auto& pressed = robot_.bumper();
  for (std::size_t i = 0; i < pressed.size(); ++i) {
    if (!pressed[i]) continue;
    const auto place = arcos::bumperAt(bumper->beams[i].robot_from_beam.yaw, parameters_);
    auto& bits = place.is_front ? sip.stall_right : sip.stall_left;
    bits |= place.bit;
    if (bumper_stall_ & (place.is_front ? 1 : 2)) {
      sip.stall_left |= Sip::kStalled;
      sip.stall_right |= Sip::kStalled;
    }
  }
}

Sip ArcosBoard::sip() const {
  const mrpt::math::TPose2D pose = odometry();
  const Odometry& motion = robot_.odometry();
  const double wheel_mmps = motion.turn_radps / parameters_.turn_radpmm;
  Sip sip;
  sip.is_moving = motion.speed_mps != 0 || motion.turn_radps != 0;
  sip.x = wrapped(pose.x, parameters_.distance_unit_mm);
  sip.y = wrapped(pose.y, parameters_.distance_unit_mm);
  const auto units = std::lround(pose.phi / (2 * M_PI) * arcos::kHeadingUnitsPerTurn);
  constexpr int kHalfTurn = arcos::kHeadingUnitsPerTurn / 2;
  sip.heading = static_cast<std::int16_t>(units >= kHalfTurn ? units - arcos::kHeadingUnitsPerTurn : units);
  sip.speed_left = rounded<std::int16_t>(motion.speed_mps * kMm - wheel_mmps);
  sip.speed_right = rounded<std::int16_t>(motion.speed_mps * kMm + wheel_mmps);
  sip.battery = rounded<std::uint8_t>(batteryVolts() * 10);
  sip.battery_decivolts = rounded<std::uint16_t>(batteryVolts() * 10);
  if (robot_.stalled()) sip.stall_left = sip.stall_right = Sip::kStalled;
  addBumpers(sip);
  if (are_motors_on_) sip.flags |= Sip::kMotorsOn;
  if (is_sonar_on_) sip.flags |= Sip::kSonarOn;
  // Clockwise from the y axis of the world, north, as a compass counts.
  if (const auto heading_rad = robot_.compass()) {
    sip.compass = static_cast<std::uint8_t>(mrpt::math::wrapTo2Pi(M_PI_2 - *heading_rad) / kRadPerDeg / 2);
  }
  if (is_sonar_on_) {
    const Echoes& echoes = robot_.sonar();
    constexpr std::size_t kSonarsMax = 32;
    for (std::size_t i = 0; i < std::min(echoes.size(), kSonarsMax); ++i) {
      sip.sonars.push_back({static_cast<std::uint8_t>(i), rounded<std::uint16_t>(echoes[i].range_m * kMm)});
    }
  }
  if (robot_.hasGripper()) sip.gripper = gripper().switches.byte();
  sip.digital_out = digital_out_;
  sip.turn_rate = rounded<std::int16_t>(motion.turn_radps / kRadPerDeg * 10);
  return sip;
}

arcos::ConfigPacket ArcosBoard::config() const {
  const MotionLimits& limits = robot_.info().type->limits;
  const auto number = [](double value) { return std::max<std::uint16_t>(1, rounded<std::uint16_t>(value)); };
  arcos::ConfigPacket config;
  config.subclass = parameters_.subclass;
  config.name = robot_.name().substr(0, 32);
  config.turn_top = number(limits.turn_max_radps / kRadPerDeg);
  config.speed_top = number(limits.speed_max_mps * kMm);
  config.turn_accel_top = number(limits.turn_accel_radps2 / kRadPerDeg);
  config.accel_top = number(std::min(limits.accel_mps2, limits.decel_mps2) * kMm);
  config.cycle_ms = rounded<std::uint8_t>(arcos::kCycle_s * 1000);
  config.has_gripper = robot_.hasGripper();
  config.has_gyro = gyroRate().has_value();
  config.has_front_sonar = parameters_.has_front_sonar;
  config.has_rear_sonar = parameters_.has_rear_sonar;
  config.low_battery_decivolts = rounded<std::uint16_t>(parameters_.low_battery_volts * 10);
  config.watchdog_ms = arcos::kWatchdog_ms;
  config.turn_max = number(parameters_.turn_degps);
  config.speed_max = number(parameters_.speed_mmps);
  config.turn_accel = config.turn_decel = number(parameters_.turn_accel_degps2);
  config.accel = config.decel = number(parameters_.accel_mmps2);
  config.front_bumpers = static_cast<std::uint8_t>(parameters_.front_bumpers);
  config.rear_bumpers = static_cast<std::uint8_t>(parameters_.rear_bumpers);
  config.ticks_per_mm = rounded<std::uint16_t>(parameters_.encoder_ticks_per_mm);
  return config;
}

arcos::EncoderTicks ArcosBoard::encoderTicks() const {
  return {rounded<std::int32_t>(left_mm_ * parameters_.encoder_ticks_per_mm),
          rounded<std::int32_t>(right_mm_ * parameters_.encoder_ticks_per_mm)};
}

}  // namespace robosim
