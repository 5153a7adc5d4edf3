#pragma once

namespace robosim {

/// Reading of one sonar or one beam of a laser in ARIA's units, as its ArSensorReading.
struct SensorReading {
  int range = 0;                                     ///< [mm]
  double x = 0, y = 0;                               ///< of the echo, in the frame of PioneerRobot::getPose() [mm]
  double local_x = 0, local_y = 0;                   ///< the same in the robot's frame [mm]
  double sensor_x = 0, sensor_y = 0, sensor_th = 0;  ///< the sensor in the robot's frame [mm, deg]
  int getRange() const { return range; }
  double getX() const { return x; }
  double getY() const { return y; }
  double getLocalX() const { return local_x; }
  double getLocalY() const { return local_y; }
  double getSensorX() const { return sensor_x; }
  double getSensorY() const { return sensor_y; }
  double getSensorTh() const { return sensor_th; }
};

}  // namespace robosim
