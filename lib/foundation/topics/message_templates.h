#pragma once
#include <string>

#include <mrpt/math/TPose2D.h>

#include "hardware/scan_geometry.h"
#include "hardware/sensor_info.h"
#include "ros/message_template.h"
#include "ros/messages.h"
#include "topics/robot_topics.h"

namespace robosim {

/// The changing fields of the messages of a robot. The first two are the stamp, in all that have a header.
enum TemplateField : std::size_t {
  kSeconds,
  kNanoseconds,
  kFirst,  ///< the first one after the stamp
  // Of odometryTemplate():
  kX = kFirst,
  kY,
  kRotationZ,
  kRotationW,
  kSpeed,
  kTurn,
  kLateral,
};

/// @name Messages in which all is set but the stamp and the fields named
/// @param frame of the header
///@{
/// Field: the ranges.
ros::MessageTemplate scanTemplate(const SensorInfo& sensor, const ScanGeometry& geometry, const std::string& frame);
/// Field: the range.
ros::MessageTemplate rangeTemplate(const SensorInfo& sensor, const std::string& frame, RosDistribution distribution);
/// Fields: number of points, and of their bytes. It has no points: these, after their number of bytes (32 bits),
/// replace the last five bytes but the very last.
ros::MessageTemplate cloudTemplate(const std::string& frame);
/// Without the picture, which follows; its number of bytes replaces the last four.
ros::MessageTemplate pictureTemplate(const std::string& frame);
ros::MessageTemplate cameraTemplate(const CameraInfo& camera, const std::string& frame);
/// Field: the temperature.
ros::MessageTemplate temperatureTemplate(const std::string& frame);
/// Field: the voltage.
ros::MessageTemplate batteryTemplate(const std::string& frame);
/// Fields: z and w of the orientation.
ros::MessageTemplate compassTemplate(const std::string& frame);
/// Fields: from kX to kLateral.
ros::MessageTemplate odometryTemplate(const std::string& frame, const std::string& child);
///@}

/// Sets the fields from kX to kRotationW.
void setPose(ros::MessageTemplate& odometry, const mrpt::math::TPose2D& pose);

/// Rotations about z, then the new y, then the new x.
ros::Quaternion rotationOf(double yaw, double pitch, double roll);
/// The rotation b, then a.
ros::Quaternion product(const ros::Quaternion& a, const ros::Quaternion& b);

}  // namespace robosim
