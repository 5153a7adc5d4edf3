#pragma once
#include <array>
#include <string>

#include "hardware/measurement.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// How the measurements of a kind of sensor become messages. doc/ros2.md has the same table, which a test compares.
struct SensorTopicRow {
  SensorKind kind;
  const char* topics;    ///< of a sensor with the kind's name as its label, below the robot's; "" for none
  const char* messages;  ///< their types
  const char* content;
};

inline constexpr std::array kSensorTopicRows{
    SensorTopicRow{SensorKind::sonar, "sonar/range_0, sonar/range_1, …; sonar/points",
                   "sensor_msgs/msg/Range; sensor_msgs/msg/PointCloud2",
                   "one Range for each sonar; the echoes of all in the robot's frame"},
    SensorTopicRow{SensorKind::laser, "scan", "sensor_msgs/msg/LaserScan",
                   "ranges counter-clockwise; a scanner without evenly spaced beams has topics as an infrared sensor"},
    SensorTopicRow{SensorKind::lidar, "lidar/points", "sensor_msgs/msg/PointCloud2", "the echoes in the robot's frame"},
    SensorTopicRow{SensorKind::infrared, "infrared/range_0, infrared/range_1, …; infrared/points",
                   "sensor_msgs/msg/Range; sensor_msgs/msg/PointCloud2", "as of sonars"},
    SensorTopicRow{SensorKind::heat, "heat", "sensor_msgs/msg/Temperature", "the reading as a temperature"},
    SensorTopicRow{SensorKind::bumper, "bumper", "std_msgs/msg/UInt8MultiArray", "1 for each pressed segment, else 0"},
    SensorTopicRow{SensorKind::odometry, "odom; /tf", "nav_msgs/msg/Odometry; tf2_msgs/msg/TFMessage",
                   "pose since the start and speeds; the transform from odom to base_link"},
    SensorTopicRow{SensorKind::compass, "compass", "sensor_msgs/msg/Imu", "orientation only"},
    SensorTopicRow{SensorKind::camera, "camera/image_raw/compressed; camera/camera_info",
                   "sensor_msgs/msg/CompressedImage; sensor_msgs/msg/CameraInfo",
                   "the JPEG file, in the optical frame; the camera's matrices. A ray-cast camera with depths or "
                   "identities also has camera/depth/image_raw (32FC1 [m]) and camera/identity/image_raw (32SC1), of "
                   "the type sensor_msgs/msg/Image"},
    SensorTopicRow{
        SensorKind::blob_finder, "blob_finder", "std_msgs/msg/Float64MultiArray",
        "for each colour pixels, x, y, left, top, width, height; the layout's first label names the colours"},
    SensorTopicRow{SensorKind::battery, "battery", "sensor_msgs/msg/BatteryState", "voltage; all else is NaN"},
    SensorTopicRow{SensorKind::beacons, "beacons", "std_msgs/msg/Float64MultiArray",
                   "ranges; infinity for a beacon that is not received"},
    SensorTopicRow{
        SensorKind::values, "values", "std_msgs/msg/Float64MultiArray; sensor_msgs/msg/NavSatFix; sensor_msgs/msg/Imu",
        "the values; the layout's label names the quantities. `gnss` is a NavSatFix, `imu` an Imu without orientation"},
    SensorTopicRow{SensorKind::unknown, "", "", "none"},
};
/// The topic of a sensor below the robot's, or the beginning of its topics: "scan" for "laser", "scan_2" for "laser_2";
/// other labels as they are.
std::string topicOf(const SensorInfo& sensor);

static_assert(kSensorTopicRows.size() == kSensorKindNames.size(), "every kind of sensor has a row");

}  // namespace robosim
