#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>

#include "ros/messages.h"

namespace robosim {

/// How the messages of a type become observations.
enum class BagUse : std::uint8_t {
  none,
  observation,
  odometry,
  transforms,   ///< of /tf
  camera_info,  ///< of the pictures beside it
};

/// What is made of a message's data, without its type's.
struct BagUseRow {
  const char* type;
  BagUse use;
  const char* content;  ///< MRPT's class, for doc/ros2.md
};

/// What is read of the messages of a type. doc/ros2.md has the same table, which a test compares.
std::span<const BagUseRow> bagUses();
/// @param type "sensor_msgs/msg/LaserScan"
BagUse bagUseOf(const std::string& type);

/// What of a measurement is not in its message.
struct BagSensor {
  std::string type;                       ///< of the messages
  std::string label;                      ///< of the observations: "robot1/laser"
  mrpt::poses::CPose3D robot_from_frame;  ///< pose of the message's frame
  std::uint16_t id = 0;                   ///< of a range, among those of its label
  std::optional<ros::CameraInfo> camera;
};

/// What a message of any type with a header begins with, and the frame that the header's frame is the parent of.
struct BagHeader {
  std::int64_t stamp_ns = 0;
  std::string frame, child_frame;  ///< without a leading slash; child_frame only of an Odometry
};
/// @throws ros::CdrError
BagHeader bagHeaderOf(const std::string& type, std::span<const std::uint8_t> data);

/// MRPT's timestamp of nanoseconds since 1970 (its unit is 100 ns).
mrpt::Clock::time_point timestampOf(std::int64_t time_ns);

/// The observation of a message of the kind BagUse::observation or odometry, without a timestamp.
/// @throws ros::CdrError for bytes that are no message of the type; std::runtime_error for values that no observation
/// has, as of a scan without angles or a damaged picture
mrpt::obs::CObservation::Ptr bagObservation(const BagSensor& sensor, std::span<const std::uint8_t> data);
/// A scan without label and timestamp. Ranges outside range_min to range_max, and not above 0, are invalid.
/// @throws std::runtime_error for a scan without ranges, and for angles that are not finite
mrpt::obs::CObservation::Ptr scanObservation(const ros::LaserScan& scan,
                                             const mrpt::poses::CPose3D& robot_from_scanner);
/// Adds the range of a message, of which `all` is an observation, to an observation of the same label and time.
/// @returns false when they are not both ranges
bool addBagRange(mrpt::obs::CObservation& all, const mrpt::obs::CObservation& range);

/// The odometry that a transform from its origin to the robot is.
mrpt::obs::CObservation::Ptr bagOdometry(const std::string& label, const ros::Transform& odom_from_robot);

}  // namespace robosim
