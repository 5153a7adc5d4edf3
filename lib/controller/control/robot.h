#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hardware/camera_head.h"
#include "hardware/gripper_state.h"
#include "hardware/hardware.h"
#include "hardware/led_color.h"

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
  /// Index into Readings::measurements of the first sensor of a kind; nullopt for a robot without it. Here, because
  /// controllers read sensors many times in a step.
  std::optional<std::size_t> slotOf(SensorKind kind) const {
    const Slot found = slot_of_kind_[static_cast<std::size_t>(kind)];
    return found == kNoSlot ? std::nullopt : std::optional<std::size_t>(found);
  }
  /// Description of the first sensor of a kind; null for a robot without it.
  const SensorInfo* sensor(SensorKind kind) const {
    const auto found = slotOf(kind);
    return found ? &(*info().sensors)[*found] : nullptr;
  }
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

  void drive(double speed_mps, double turn_radps) { drive(speed_mps, turn_radps, 0); }
  /// @param lateral_mps to the left
  /// @throws std::invalid_argument for a lateral speed other than 0 of a robot whose drive is not omnidirectional
  void drive(double speed_mps, double turn_radps, double lateral_mps);
  void panLaser(double pan_rad);  ///< [-π/2, π/2]
  /// @name Gripper
  /// Without effect on a robot that has none.
  ///@{
  void grip();     ///< closes it: from the next step on, it holds the object between its paddles, if there is one
  void release();  ///< opens it: what it held stays where it is
  bool held() const { return gripper().holds; }  ///< whether it holds an object
  /// Of this step; of a robot without a gripper, that of an open one with nothing between its paddles.
  GripperState gripper() const;
  bool hasGripper() const { return gripper_slot_ != kNoSlot; }
  ///@}
  /// Sets the colour of the robot's LEDs from the next step on, which omnidirectional cameras of other robots see.
  /// Black, {0, 0, 0}, is off, as at the start. Without effect on real robots.
  /// @param rgb red, green and blue, each in [0, 1]
  void setLeds(const std::array<float, 3>& rgb);
  /// Colour as commanded last.
  std::array<float, 3> leds() const { return rgbOf(command().led_color); }
  /// @name Camera that pans, tilts and zooms (<ptz> of a camera)
  /// Commands are kept until the next one of their kind, and are without effect on a robot that has none. The camera
  /// moves with limited speed to the nearest aim within its limits, and its pictures and blobs follow.
  ///@{
  /// Turns it, relative to its mount. @param pan_rad to the left @param tilt_rad up
  void aimCamera(double pan_rad, double tilt_rad);
  void zoomCamera(double zoom);  ///< at least 1: by which its field of view is divided
  /// Limits the speeds of aimCamera(); 0 or less: as fast as the camera can, as at the start.
  void limitCameraSpeed(double pan_radps, double tilt_radps);
  void stopCamera();            ///< aims it where it is now
  CameraAim cameraAim() const;  ///< in this step; straight ahead without zoom for a robot that has none
  /// Limits of the camera's head; null for a robot that has none.
  const CameraHeadLimits* cameraHead() const { return hasHead() ? &(*info().sensors)[head_slot_].head : nullptr; }
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
  std::optional<double> scalar(SensorKind kind) const;
  /// Commands the last command after a change of one of its devices.
  template <typename Change>
  void changeCommand(const Change& change);
  template <typename Change>
  void changeHead(const Change& change);

  // Small, because a run may have very many robots.
  using Slot = std::uint16_t;
  static constexpr Slot kNoSlot = 0xffff;
  bool hasHead() const { return head_slot_ != kNoSlot; }

  Hardware& hardware_;
  std::array<Slot, kSensorKindNames.size()> slot_of_kind_;  ///< by kind
  Slot gripper_slot_ = kNoSlot;
  Slot head_slot_ = kNoSlot;
};

}  // namespace robosim
