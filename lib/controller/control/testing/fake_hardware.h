#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <mrpt/math/wrap2pi.h>

#include "hardware/hardware.h"

namespace robosim {

/// Test double of a base's controller: the motors are switched at once.
struct FakeBase : BaseLink {
  BaseState baseState() const override { return state; }
  void enableMotors(bool on) override { state.motors_enabled = on; }
  void enableSonar(bool on) override { sonar_on = on; }

  BaseState state{.motors_enabled = true};
  bool sonar_on = true;
};

/// Test double of a robot without a world: it executes commands within its limits, and its readings are set by the
/// test. Sonar i of `sonars` points along i · 360°/sonars, counter-clockwise from straight ahead.
class FakeHardware : public Hardware, public RefereeLink {
 public:
  explicit FakeHardware(int sonars = 16, std::string neighbour = "") {
    SensorInfo odometry = sensor(SensorKind::odometry, 0, 0);
    SensorInfo sonar = sensor(SensorKind::sonar, 5, 5);
    for (int i = 0; i < sonars; ++i) {
      const double bearing = mrpt::math::wrapToPi(2 * std::numbers::pi * i / sonars);
      sonar.beams.push_back({{kRadius_m * std::cos(bearing), kRadius_m * std::sin(bearing), 0.2, bearing, 0, 0}});
    }
    SensorInfo laser = sensor(SensorKind::laser, 8, 8.1);
    laser.beams.push_back({{0.1, 0, 0.2, 0, 0, 0}});
    SensorInfo heat = sensor(SensorKind::heat, 3, 0);
    info_.name = info_.type.edit().model = "fake";
    info_.neighbour = std::move(neighbour);
    info_.radius_m = kRadius_m;
    info_.height_m = 0.3;
    info_.type.edit().limits = {
        .speed_max_mps = 1, .turn_max_radps = 2, .accel_mps2 = 0.5, .decel_mps2 = 1, .turn_accel_radps2 = 4};
    info_.sensors = std::make_shared<std::vector<SensorInfo>>(std::vector<SensorInfo>{odometry, sonar, laser, heat});
    readings_.measurements = {Odometry{}, Echoes(static_cast<std::size_t>(sonars)), Echoes(1), Scalar{}};
    clearEchoes();
  }

  const RobotInfo& info() const override { return info_; }
  void setDrive(const Drive& drive) { info_.type.edit().drive = drive; }
  const std::vector<std::string>& robots() const override { return robot_names; }
  const Readings& readings() const override { return readings_; }
  void command(const Command& command) override { command_ = command; }
  const Command& lastCommand() const override { return command_; }
  void send(const std::string& to, const std::string& text) override { sent.push_back({info_.name, to, text}); }
  RefereeLink* referee() override { return this; }
  BaseLink* base() override { return base_link ? &*base_link : nullptr; }
  void checkWin() override { ++win_checks; }

  Readings& mutableReadings() { return readings_; }
  RobotInfo& mutableInfo() { return info_; }
  const Odometry& odometry() const { return std::get<Odometry>(readings_.measurements[0]); }
  Odometry& mutableOdometry() { return std::get<Odometry>(readings_.measurements[0]); }

  /// Adds a sensor; before a Robot is constructed. @return its slot
  std::size_t addSensor(SensorKind kind, const std::vector<double>& beam_yaws_rad, Measurement measurement) {
    auto sensors = std::make_shared<std::vector<SensorInfo>>(*info_.sensors);
    SensorInfo added = sensor(kind, 0, 0);
    for (const double yaw : beam_yaws_rad) added.beams.push_back({{0, 0, 0.2, yaw, 0, 0}});
    sensors->push_back(added);
    info_.sensors = sensors;
    readings_.measurements.push_back(std::move(measurement));
    return sensors->size() - 1;
  }

  /// Sets the range of the sensor in a slot along its beam; beyond its maximum range: no echo.
  void setRange(std::size_t slot, std::size_t beam, double range_m) {
    const SensorInfo& info = (*info_.sensors)[slot];
    const double reported_m = range_m < info.range_max_m ? range_m : info.no_echo_m;
    const auto end = info.beams[beam].robot_from_beam.composePoint({reported_m, 0, 0});
    std::get<Echoes>(readings_.measurements[slot])[beam] = {
        static_cast<float>(reported_m),
        {static_cast<float>(end.x), static_cast<float>(end.y), static_cast<float>(end.z)}};
  }
  void setSonarRange(std::size_t beam, double range_m) { setRange(1, beam, range_m); }
  void setLaserRange(double range_m) { setRange(2, 0, range_m); }
  void clearEchoes() {
    for (std::size_t slot : {1u, 2u}) {
      for (std::size_t beam = 0; beam < (*info_.sensors)[slot].beams.size(); ++beam) setRange(slot, beam, 1e9);
    }
  }
  void setHeat(double heat) { std::get<Scalar>(readings_.measurements[3]).value = heat; }

  /// One time step: drives by the last command, unless `blocked`; then `sense` may change the readings.
  void advance() {
    const double dt = readings_.time.period_s;
    Odometry& odo = mutableOdometry();
    const MotionLimits& limits = info_.type->limits;
    const double accel = std::abs(command_.speed_mps) > std::abs(odo.speed_mps) ? limits.accel_mps2 : limits.decel_mps2;
    odo.speed_mps = approach(odo.speed_mps, command_.speed_mps, limits.speed_max_mps, accel * dt);
    odo.turn_radps =
        approach(odo.turn_radps, command_.turn_radps, limits.turn_max_radps, limits.turn_accel_radps2 * dt);
    if (blocked) odo.speed_mps = 0;
    readings_.stalled = blocked && command_.speed_mps != 0;
    mrpt::math::TPose2D& pose = odo.odom_from_robot;
    const double middle = pose.phi + odo.turn_radps * dt / 2;
    pose.x += odo.speed_mps * dt * std::cos(middle);
    pose.y += odo.speed_mps * dt * std::sin(middle);
    pose.phi = mrpt::math::wrapToPi(pose.phi + odo.turn_radps * dt);
    readings_.inbox.clear();
    ++readings_.time.step;
    if (sense) sense(*this);
  }

  bool blocked = false;                      ///< the robot cannot move
  std::function<void(FakeHardware&)> sense;  ///< called at the end of each step
  std::vector<RobotMessage> sent;
  std::vector<std::string> robot_names{"fake"};  ///< of the run
  std::optional<FakeBase> base_link;             ///< none, as a simulated robot, until the test adds it
  int win_checks = 0;                            ///< number of CheckWin requests

  static constexpr double kRadius_m = 0.25;

 private:
  static SensorInfo sensor(SensorKind kind, double range_max_m, double no_echo_m) {
    SensorInfo info;
    info.kind = kind;
    info.label = nameOf(kind);
    info.range_max_m = range_max_m;
    info.no_echo_m = no_echo_m;
    return info;
  }
  static double approach(double from, double to, double limit, double change) {
    return std::clamp(std::clamp(to, -limit, limit), from - change, from + change);
  }

  RobotInfo info_;
  Readings readings_;
  Command command_;
};

}  // namespace robosim
