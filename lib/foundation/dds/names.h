#pragma once
#include <string>

namespace robosim::dds {

/// "rt/robot1/scan" of ROS's "/robot1/scan". Source: ros2/rmw_cyclonedds, namespace_prefix.hpp
std::string ddsTopicName(const std::string& topic);
/// "sensor_msgs::msg::dds_::LaserScan_" of "sensor_msgs/msg/LaserScan". Source: MessageTypeSupport_impl.hpp there
std::string ddsTypeName(const std::string& message_type);

}  // namespace robosim::dds
