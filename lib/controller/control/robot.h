#pragma once
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hardware/gripper_state.h"
#include "hardware/hardware.h"

namespace robosim {

/// Programming interface of a robot in SI units: readings by sensor kind, and commands, over any Hardware.
/// PioneerRobot and ScoutRobot provide the same with ARIA's and the Nomad's names and units.
class Robot {
 public:
  /// @param hardware must outlive this
  explicit Robot(Hardware& hardware);

  const RobotInfo& info() const { return hardware_.info(); }
  const std::string& name() const { return info().name; }
  const Readings& readings() const { return hardware_.readings(); }
  std::uint64_t stepNumber() const { return readings().time.step; }
  double time() const { return readings().time.seconds(); }  ///< [s] since the start
  /// Number of steps that take at least `seconds`.
  std::uint64_t stepsIn(double seconds) const {
    return static_cast<std::uint64_t>(std::ceil(seconds / readings().time.period_s));
  }

  /// @name Readings of the first sensor of a kind in this step
  /// For a robot without such a sensor: no echoes, nullopt, identity odometry.
  ///@{
  const Echoes& sonar() const { return echoes(SensorKind::sonar); }
  const Echoes& laser() const { return echoes(SensorKind::laser); }
  const Echoes& infrared() const { return echoes(SensorKind::infrared); }
  std::optional<double> heat() const { return scalar(SensorKind::heat); }
  std::optional<double> compass() const { return scalar(SensorKind::compass); }  ///< [rad], world frame
  std::optional<double> battery() const { return scalar(SensorKind::battery); }  ///< [V]
  const std::vector<std::uint8_t>& bumper() const;
  const Odometry& odometry() const;
  const Image& image() const;  ///< also empty in a step without a picture
  const Blobs& blobs() const;  ///< also empty in a step without a picture
  ///@}
  /// Echoes of the first range sensor of a kind; the same as sonar(), laser() or infrared().
  const Echoes& echoes(SensorKind kind) const;
  /// Measurement of the first sensor of a kind, such as Values; null for a robot without it.
  const Measurement* measurement(SensorKind kind) const;
  /// Measurement of the sensor with a label; null for a robot without it. Takes time in proportion to the sensors.
  const Measurement* measurement(const std::string& label) const;
  /// Description of the first sensor of a kind; null for a robot without it.
  const SensorInfo* sensor(SensorKind kind) const;
  bool stalled() const { return readings().stalled; }
  /// State of the base beyond its sensors; all absent for a robot that is simulated.
  BaseState baseState() const {
    const BaseLink* base = hardware_.base();
    return base ? base->baseState() : BaseState{};
  }
  /// Switch the motors and sonars of a robot whose base has a controller (Hardware::base()); without effect otherwise.
  void enableMotors(bool on) {
    if (BaseLink* base = hardware_.base()) base->enableMotors(on);
  }
  void enableSonar(bool on) {
    if (BaseLink* base = hardware_.base()) base->enableSonar(on);
  }

  void drive(double speed_mps, double turn_radps);
  void panLaser(double pan_rad);  ///< [-π/2, π/2]
  /// @name Gripper
  /// Without effect on a robot that has none.
  ///@{
  void grip();     ///< closes it: from the next step on, it holds the object between its paddles, if there is one
  void release();  ///< opens it: what it held stays where it is
  bool held() const { return gripper().holds; }  ///< whether it holds an object
  /// Of this step; of a robot without a gripper, that of an open one with nothing between its paddles.
  GripperState gripper() const;
  bool hasGripper() const { return gripper_slot_.has_value(); }
  ///@}
  void stop() { drive(0, 0); }
  /// Stops as hard as the robot can (MotionLimits::emergency_decel_mps2), until the next drive().
  void stopInEmergency();
  /// Stops permanently; `found` reports that the robot has found its goal.
  void halt(Activity why = Activity::halted);
  Activity activity() const { return command().activity; }
  const Command& command() const { return hardware_.lastCommand(); }

  /// @throws std::invalid_argument for an unknown receiver or too long a text.
  void send(const std::string& to, const std::string& text) { hardware_.send(to, text); }
  /// Names of all robots of the run in the world's order, including this one.
  const std::vector<std::string>& robots() const { return hardware_.robots(); }
  /// Sends a message to every other robot. It counts as one of the kMaxMessagesSent messages of a step, however many
  /// robots receive it; those beyond are dropped and counted.
  /// @throws std::invalid_argument for too long a text.
  void broadcast(const std::string& text) { hardware_.broadcast(text); }
  /// Requests CheckWin, whether this robot is near enough to the gold; the next step's readings contain the result.
  /// Without effect for hardware without a referee.
  void checkWin() {
    if (RefereeLink* referee = hardware_.referee()) referee->checkWin();
  }
  /// Name of the robot that has won; empty until then, and always without a referee.
  const std::string& winner() const { return readings().winner; }
  /// Messages delivered to this robot in the last step.
  const std::vector<RobotMessage>& inbox() const { return readings().inbox; }

 private:
  std::optional<std::size_t> slot(SensorKind kind) const;
  std::optional<double> scalar(SensorKind kind) const;
  void setGrip(bool is_closed);

  Hardware& hardware_;
  std::vector<int> slot_of_kind_;  ///< by kind; -1 for none
  std::optional<std::size_t> gripper_slot_;
};

}  // namespace robosim
