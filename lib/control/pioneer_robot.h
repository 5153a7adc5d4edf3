#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <mrpt/math/TPose2D.h>

#include "control/action.h"
#include "control/blocking_controller.h"
#include "control/motion_profile.h"
#include "control/pioneer_pose.h"
#include "control/robot.h"

namespace robosim {

/// One sonar's echo in ARIA's units.
struct PioneerSonarReading {
  int range = 0;                                     ///< [mm]
  double x = 0, y = 0;                               ///< of the echo, in the frame of getPose() [mm]
  double local_x = 0, local_y = 0;                   ///< the same in the robot's frame [mm]
  double sensor_x = 0, sensor_y = 0, sensor_th = 0;  ///< the sonar in the robot's frame [mm, deg]
  int getRange() const { return range; }
  double getX() const { return x; }
  double getY() const { return y; }
  double getLocalX() const { return local_x; }
  double getLocalY() const { return local_y; }
  double getSensorX() const { return sensor_x; }
  double getSensorY() const { return sensor_y; }
  double getSensorTh() const { return sensor_th; }
};

/// Adapter with the names and units of ARIA (mm, mm/s, deg, deg/s; counter-clockwise positive), and with
/// acquireSensorReadings() of the 2005 RoboSim. Requires a robot with odometry.
///
/// In a Controller: construct one for the robot and call update() at the start of each step. In a BlockingController's
/// loop: construct it with the clock and call its waitForNextStep(), which calls update().
///
/// As in ARIA, setVel … move are direct motion: they disable the actions until clearDirectMotion().
class PioneerRobot {
 public:
  /// @name Sensors for acquireSensorReadings(); may be combined by |
  ///@{
  static constexpr unsigned SONAR = 1, LASER = 2, HEAT = 4;
  ///@}

  /// @throws std::invalid_argument for a robot without odometry.
  explicit PioneerRobot(Robot& robot);
  PioneerRobot(Robot& robot, StepClock& clock);
  PioneerRobot(const PioneerRobot&) = delete;
  PioneerRobot& operator=(const PioneerRobot&) = delete;

  /// Processes a new step: continues the direct motion, or else resolves the actions. Call it once per step.
  void update();

  /// @name Running
  /// Nothing runs concurrently with the controller; lock() and unlock() do nothing and exist for ARIA programs.
  ///@{
  /// @throws std::logic_error for a PioneerRobot that was made without a clock.
  void waitForNextStep();
  void run();  ///< steps with the actions until stopRunning() or the robot halts
  void stopRunning() { running_ = false; }
  bool isRunning() const { return running_; }
  void lock() {}
  void unlock() {}
  bool isConnected() const { return robot_.activity() == Activity::active; }
  void disconnect();  ///< stops the robot permanently
  ///@}

  /// @name Motors and sonars; both are on at the start
  ///@{
  void enableMotors() { drive_.enable(true); }
  void disableMotors() { drive_.enable(false); }
  bool areMotorsEnabled() const { return drive_.enabled(); }
  void enableSonar() { sonar_on_ = true; }
  void disableSonar() { sonar_on_ = false; }  ///< no reading is new; all are without echo
  bool areSonarsEnabled() const { return sonar_on_; }
  ///@}

  /// @name Direct motion
  ///@{
  void setVel(double mm_ps);
  void setVel2(double left_mm_ps, double right_mm_ps);
  void setRotVel(double deg_ps);
  void setHeading(double deg);       ///< in the frame of getPose(), by the smaller angle
  void setDeltaHeading(double deg);  ///< relative to the present heading
  void move(double mm);              ///< negative: backwards
  void stop();
  /// Whether move() is within this distance of its end; true without an active move(). 0 means 40 mm.
  bool isMoveDone(double delta_mm = 0) const;
  /// The same for setHeading() and setDeltaHeading(). 0 means 3 deg.
  bool isHeadingDone(double delta_deg = 0) const;
  void clearDirectMotion();  ///< enables the actions again
  bool isDirectMotion() const { return direct_motion_; }
  ///@}

  /// @name Limits
  /// Values above the hardware's limits are clamped. @return false, without effect, for a value that is not positive.
  ///@{
  bool setTransVelMax(double mm_ps);
  bool setTransAccel(double mm_ps2);
  bool setTransDecel(double mm_ps2);
  bool setRotVelMax(double deg_ps);
  bool setRotAccel(double deg_ps2);
  bool setRotDecel(double deg_ps2);
  double getTransVelMax() const;
  double getTransAccel() const;
  double getTransDecel() const;
  double getRotVelMax() const;
  double getRotAccel() const;
  double getRotDecel() const;
  ///@}

  /// @name State
  ///@{
  const std::string& getName() const { return robot_.name(); }
  PioneerPose getPose() const;  ///< by odometry, relative to the start pose or to moveTo()
  double getX() const { return getPose().x; }
  double getY() const { return getPose().y; }
  double getTh() const { return getPose().th; }
  void moveTo(const PioneerPose& pose);  ///< sets the present pose; getPose() continues from it
  double getVel() const;
  double getRotVel() const;
  double getLeftVel() const;
  double getRightVel() const;
  bool isLeftMotorStalled() const { return robot_.stalled(); }  ///< a blocked body stalls both wheels
  bool isRightMotorStalled() const { return robot_.stalled(); }
  int getStallValue() const { return robot_.stalled() ? 0x0101 : 0; }  ///< bit 0: left wheel, bit 8: right wheel
  double getRobotRadius() const;                                       ///< [mm]
  /// 13.0 V, fully charged, for a robot without a battery sensor.
  double getBatteryVoltage() const { return robot_.battery().value_or(13.0); }
  ///@}

  /// @name Requests (2005)
  /// A request is answered in the next step; then the readings count as new until they are requested again. All
  /// readings of a step arrive in one packet; without requests they are new in every step.
  ///@{
  /// @throws std::invalid_argument when the robot lacks a requested sensor: it would never be answered.
  void acquireSensorReadings(unsigned sensors);
  bool isHeatNew() const { return isNew(SensorKind::heat, HEAT); }
  bool isLaserNew() const { return isNew(SensorKind::laser, LASER); }
  bool isSonarNew() const { return sonar_on_ && isNew(SensorKind::sonar, SONAR); }
  bool isSonarNew(int number) const { return isSonarNew() && number >= 0 && number < getNumSonar(); }
  ///@}

  /// @name Sonar; numbers from 0, in the order of the robot's model
  ///@{
  int getNumSonar() const { return static_cast<int>(robot_.sonar().size()); }
  int getSonarRange(int number) const;                                   ///< [mm]; -1 for no such sonar
  std::optional<PioneerSonarReading> getSonarReading(int number) const;  ///< nullopt for no such sonar
  /// The shortest range among the sonars that point between two angles, counter-clockwise from `from_deg` to `to_deg`;
  /// -1 when there are none.
  int getClosestSonarRange(double from_deg, double to_deg) const;
  int getClosestSonarNumber(double from_deg, double to_deg) const;  ///< -1 for none
  ///@}

  /// @name Laser and heat
  ///@{
  int getNumLaser() const { return static_cast<int>(robot_.laser().size()); }
  int getLaserRange(int number = 0) const;                      ///< [mm]; -1 for no such beam
  void turnLaser(double deg);                                   ///< pan angle of a turnable laser, in [-90, 90]
  double getHeat() const { return robot_.heat().value_or(0); }  ///< 0 for a robot without a heat sensor
  ///@}

  /// @name Sonar and laser combined; distances [mm] from the robot's centre
  ///@{
  /// The nearest echo that lies between the two directions, counter-clockwise; `if_none` when there is none.
  double checkRangeDevicesCurrentPolar(double from_deg, double to_deg, double if_none = 30000) const;
  /// The nearest echo within the rectangle between two corners in the robot's frame; `if_none` when there is none.
  double checkRangeDevicesCurrentBox(double x1, double y1, double x2, double y2, double if_none = 30000) const;
  ///@}

  /// @name Actions
  ///@{
  /// @param action must outlive its entry. The highest priority comes first.
  void addAction(Action& action, int priority) { actions_.add(action, priority); }
  bool remAction(const Action& action) { return actions_.remove(action); }
  Action* findAction(const std::string& name) const { return actions_.find(name); }
  ///@}

 private:
  bool isNew(SensorKind kind, unsigned sensor) const;
  bool limitWay(double AxisLimits::*limit, double value);
  bool limitTurn(double AxisLimits::*limit, double value);
  void obey(const ActionDesired& desired);
  template <typename Accept>
  double nearestEcho(const Accept& accept, double if_none) const;

  Robot& robot_;
  StepClock* clock_ = nullptr;
  ProfiledDrive drive_;
  ActionList actions_;
  mrpt::math::TPose2D aria_from_odom_;
  std::array<std::optional<std::uint64_t>, 3> requested_in_step_;  ///< by SONAR, LASER, HEAT
  bool sonar_on_ = true;
  bool direct_motion_ = false;
  bool running_ = true;
};

}  // namespace robosim
