#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <mrpt/math/TPose3D.h>

#include "hardware/measurement.h"
#include "hardware/sensor_info.h"
#include "ros/message_type.h"
#include "ros/messages.h"

namespace robosim {

/// @file
/// Measurements from topics of ROS 2: the inverse of RobotTopics, of any program's messages (doc/ros2.md).

/// A topic of which messages are read.
struct SensorSource {
  std::string topic;  ///< below the robot's: "scan", "sonar/range_3"
  const ros::MessageType* type = nullptr;
  std::size_t beam = 0;  ///< of a sensor with a topic for each beam
};

/// The topics of a sensor; none for kinds that are not read: blob finders, beacons, values.
std::vector<SensorSource> sourcesOf(const SensorInfo& sensor);

/// The scanner that a message is of, with the label and the noise of another one: beams counter-clockwise, ranges of
/// the message. @throws std::runtime_error for a scan that no scanner has, and why
SensorInfo scannerOf(const ros::LaserScan& scan, const mrpt::math::TPose3D& robot_from_scan, const SensorInfo& like);

/// Sets the measurement, or one echo of it, from a message of a source. A scan must be of scannerOf() this sensor. An
/// Odometry is in its own frame, whatever the start.
/// @throws ros::CdrError for bytes that are no such message
/// @throws std::runtime_error for a scan of another number of beams, and a picture that is no JPEG
void readMeasurement(const SensorInfo& sensor, std::size_t beam, std::span<const std::uint8_t> message,
                     Measurement& measurement);

}  // namespace robosim
