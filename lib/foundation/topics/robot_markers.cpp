#include "topics/robot_markers.h"

#include <cmath>
#include <utility>

namespace robosim {
namespace {

constexpr std::size_t kFields = 7;  ///< of a marker that change: stamp, action, position and rotation
constexpr double kArrow_m = 0.04;   ///< thickness

}  // namespace

Topic RobotMarkers::topic() { return {"/robots", &ros::typeOf<ros::MarkerArray>(), TopicDelivery::steady}; }

void RobotMarkers::add(const RobotInfo& robot) {
  const std::uint32_t rgb = robot.color_rgb.value_or(0x808080);
  const auto channel = [rgb](unsigned shift) { return static_cast<float>((rgb >> shift) & 0xFF) / 255; };
  ros::Marker body;
  body.header.frame_id = "map";
  body.ns = robot.name;
  body.type = ros::Marker::kCylinder;
  body.scale = {2 * robot.radius_m, 2 * robot.radius_m, robot.height_m};
  body.pose.position.z = robot.height_m / 2;
  body.color = {channel(16), channel(8), channel(0), 1};
  body.text = robot.name;
  ros::Marker arrow = body;
  arrow.id = 1;
  arrow.type = ros::Marker::kArrow;
  arrow.scale = {robot.radius_m, kArrow_m, kArrow_m};
  arrow.pose.position.z = robot.height_m + kArrow_m / 2;
  arrow.color = {0.1F, 0.1F, 0.1F, 1};
  arrow.text.clear();
  robots_.push_back(std::move(body));
  robots_.push_back(std::move(arrow));
  message_ = {};
}

std::span<const std::uint8_t> RobotMarkers::message(std::span<const std::optional<mrpt::math::TPose2D>> poses,
                                                    std::uint64_t time_ns) {
  if (message_.empty()) {
    const ros::MarkerArray all{robots_};
    message_ = ros::MessageTemplate(all);
    for (const auto& marker : all.markers) {
      const auto& [position, orientation] = marker.pose;
      message_.add(all, marker.header.stamp.sec);
      message_.add(all, marker.header.stamp.nanosec);
      message_.add(all, marker.action);
      message_.add(all, position.x);
      message_.add(all, position.y);
      message_.add(all, orientation.z);
      message_.add(all, orientation.w);
    }
  }
  const ros::Time stamp = timeOf(time_ns);
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const std::size_t robot = i / kMarkers, first = i * kFields;
    const bool is_here = robot < poses.size() && poses[robot];
    message_.set(first, stamp.sec);
    message_.set(first + 1, stamp.nanosec);
    message_.set(first + 2, is_here ? ros::Marker::kAdd : ros::Marker::kDelete);
    if (!is_here) continue;
    const auto& pose = *poses[robot];
    message_.set(first + 3, pose.x);
    message_.set(first + 4, pose.y);
    message_.set(first + 5, std::sin(pose.phi / 2));
    message_.set(first + 6, std::cos(pose.phi / 2));
  }
  return message_.bytes();
}

}  // namespace robosim
