#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "aria/pioneer_pose.h"
#include "aria/range_buffer.h"
#include "aria/sensor_reading.h"
#include "control/robot.h"

namespace robosim {

/// What a PioneerRobot measures, with the names and units of ARIA (mm, mm/s, deg, deg/s; counter-clockwise positive),
/// and with acquireSensorReadings() of the 2005 RoboSim.
class PioneerSensors {
 public:
  /// @name Sensors for acquireSensorReadings(); may be combined by |
  ///@{
  static constexpr unsigned SONAR = 1, LASER = 2, HEAT = 4;
  ///@}

  explicit PioneerSensors(Robot& robot) : robot_(robot) {}
  PioneerSensors(const PioneerSensors&) = delete;
  PioneerSensors& operator=(const PioneerSensors&) = delete;

  /// @name State
  ///@{
  const std::string& getName() const { return robot_.name(); }
  double time() const { return robot_.time(); }  ///< simulation time [s] since the start of the run
  PioneerPose getPose() const;                   ///< by odometry, relative to the start pose or to moveTo()
  PioneerPose getEncoderPose() const;            ///< by odometry, relative to the start pose
  double getX() const { return getPose().x; }
  double getY() const { return getPose().y; }
  double getTh() const { return getPose().th; }
  double findDistanceTo(const PioneerPose& place) const { return getPose().findDistanceTo(place); }
  double findAngleTo(const PioneerPose& place) const { return getPose().findAngleTo(place); }
  /// The turn from the present heading towards a place.
  double findDeltaHeadingTo(const PioneerPose& place) const { return Math::subAngle(findAngleTo(place), getTh()); }
  PioneerTransform getToGlobalTransform() const { return PioneerTransform(getPose()); }  ///< from the robot's frame
  PioneerTransform getEncoderTransform() const;  ///< from getEncoderPose()'s frame to getPose()'s
  double getVel() const;
  double getRotVel() const;
  double getLatVel() const;
  double getLeftVel() const;
  double getRightVel() const;
  double getRobotRadius() const;  ///< [mm]
  ///@}

  /// @name Battery, compass and emergency stop
  /// A robot without the sensor returns what ARIA does: 13.0 V, fully charged; 0% and 0°; not pressed.
  ///@{
  double getBatteryVoltage() const { return robot_.battery().value_or(13.0); }
  double getRealBatteryVoltage() const { return getBatteryVoltage(); }
  bool haveStateOfCharge() const { return robot_.baseState().charge_percent.has_value(); }
  double getStateOfCharge() const { return robot_.baseState().charge_percent.value_or(0); }  ///< [%]
  /// Heading in the world [deg], in [0, 360).
  double getCompass() const;
  bool isEStopPressed() const { return robot_.baseState().estop_pressed.value_or(false); }
  ///@}

  /// @name Stall and bumpers
  /// The base reports which wheel is stalled; without it, a blocked body stalls both. Bumper segments are numbered from
  /// 0, clockwise: those in front from left to right, those behind from right to left.
  ///@{
  bool isLeftMotorStalled() const { return robot_.baseState().left_stalled.value_or(robot_.stalled()); }
  bool isRightMotorStalled() const { return robot_.baseState().right_stalled.value_or(robot_.stalled()); }
  /// Bit 0: left wheel, bits 1 to 7: rear bumpers, bit 8: right wheel, bits 9 to 15: front bumpers.
  int getStallValue() const;
  bool hasFrontBumpers() const { return getNumFrontBumpers() > 0; }
  bool hasRearBumpers() const { return getNumRearBumpers() > 0; }
  int getNumFrontBumpers() const { return static_cast<int>(bumpers(true).size()); }
  int getNumRearBumpers() const { return static_cast<int>(bumpers(false).size()); }
  /// Mean direction [deg] of the pressed segments in front or behind, in the robot's frame; nullopt when none is.
  std::optional<double> getBumpDirection(bool front) const;
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
  int getSonarRange(int number) const;                             ///< [mm]; -1 for no such sonar
  bool hasSonarEcho(int number) const;                             ///< whether the sonar detects something
  std::optional<SensorReading> getSonarReading(int number) const;  ///< nullopt for no such sonar
  /// The shortest range among the sonars that point between two angles, counter-clockwise from `from_deg` to `to_deg`;
  /// -1 when there are none.
  int getClosestSonarRange(double from_deg, double to_deg) const;
  int getClosestSonarNumber(double from_deg, double to_deg) const;  ///< -1 for none
  ///@}

  /// @name Laser and heat
  ///@{
  int getNumLaser() const { return static_cast<int>(robot_.laser().size()); }
  int getLaserRange(int number = 0) const;                             ///< [mm]; -1 for no such beam
  bool hasLaserEcho(int number) const;                                 ///< whether the beam ends at something
  std::optional<SensorReading> getLaserReading(int number = 0) const;  ///< nullopt for no such beam
  void turnLaser(double deg);                                          ///< pan angle of a turnable laser, in [-90, 90]
  double getHeat() const {
    return robot_.heat().value_or(0);
  }  ///< 0 for a robot without a heat sensor
     ///@}

 protected:
  struct Bumper {
    double direction;  ///< [deg]
    bool pressed;
  };

  /// The closest of this step's sonar and laser echoes whose place in the robot's frame [mm] is accepted.
  std::optional<ClosestPoint> nearestEcho(const std::function<bool(double x, double y)>& accept) const;
  void setPose(const PioneerPose& pose);
  /// Segments in front or behind, as they are numbered.
  std::vector<Bumper> bumpers(bool front) const;

  Robot& robot_;
  mrpt::math::TPose2D aria_from_odom_;
  bool sonar_on_ = true;

 private:
  bool isNew(SensorKind kind, unsigned sensor) const;
  const Echo* echoOf(SensorKind kind, int number) const;
  SensorReading readingOf(SensorKind kind, int number, int range, bool on) const;

  std::array<std::optional<std::uint64_t>, 3> requested_in_step_;  ///< by SONAR, LASER, HEAT
};

}  // namespace robosim
