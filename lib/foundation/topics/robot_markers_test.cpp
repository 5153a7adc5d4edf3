#include "topics/robot_markers.h"

#include <cmath>

#include <gtest/gtest.h>

#include "ros/cdr.h"

namespace robosim {
namespace {

using Poses = std::vector<std::optional<mrpt::math::TPose2D>>;

RobotInfo robotNamed(const std::string& name, double radius_m) {
  RobotInfo robot;
  robot.name = name;
  robot.radius_m = radius_m;
  robot.height_m = 0.5;
  robot.color_rgb = 0xFF0080;
  return robot;
}

TEST(RobotMarkers, ShowEachRobotAtItsTruePose) {
  RobotMarkers markers;
  markers.add(robotNamed("Ann", 0.2));
  markers.add(robotNamed("Bob 2", 0.3));
  const Poses poses{mrpt::math::TPose2D(1, 2, 0), mrpt::math::TPose2D(-3, 4, M_PI)};
  const auto array = ros::decode<ros::MarkerArray>(markers.message(poses, 2'500'000'000));
  ASSERT_EQ(array.markers.size(), 4u);
  const ros::Marker& ann = array.markers[0];
  EXPECT_EQ(ann.header, (ros::Header{{2, 500'000'000}, "map"}));
  EXPECT_EQ(ann.ns, "Ann");
  EXPECT_EQ(ann.type, ros::Marker::kCylinder);
  EXPECT_EQ(ann.action, ros::Marker::kAdd);
  EXPECT_EQ(ann.pose, (ros::Pose{{1, 2, 0.25}, {0, 0, 0, 1}}));
  EXPECT_EQ(ann.scale, (ros::Vector3{0.4, 0.4, 0.5}));
  EXPECT_EQ(ann.color, (ros::ColorRGBA{1, 0, 128 / 255.0F, 1}));
  const ros::Marker& arrow_of_bob = array.markers[3];
  EXPECT_EQ(arrow_of_bob.ns, "Bob 2");
  EXPECT_EQ(arrow_of_bob.type, ros::Marker::kArrow);
  EXPECT_EQ(arrow_of_bob.pose.position, (ros::Point{-3, 4, 0.52}));
  EXPECT_EQ(arrow_of_bob.pose.orientation.z, 1);
  EXPECT_NEAR(arrow_of_bob.pose.orientation.w, 0, 1e-15);
}

TEST(RobotMarkers, RemoveThoseOfARobotThatIsNotInTheWorld) {
  RobotMarkers markers;
  markers.add(robotNamed("Ann", 0.2));
  markers.message(Poses{mrpt::math::TPose2D(1, 2, 0)}, 0);
  for (const auto& marker : ros::decode<ros::MarkerArray>(markers.message(Poses{std::nullopt}, 1)).markers)
    EXPECT_EQ(marker.action, ros::Marker::kDelete);
  const auto back = ros::decode<ros::MarkerArray>(markers.message(Poses{mrpt::math::TPose2D(5, 2, 0)}, 2));
  EXPECT_EQ(back.markers[0].action, ros::Marker::kAdd);
  EXPECT_EQ(back.markers[0].pose.position.x, 5);
}

TEST(RobotMarkers, ShowARobotThatIsAdded) {
  RobotMarkers markers;
  markers.add(robotNamed("Ann", 0.2));
  markers.message(Poses{mrpt::math::TPose2D(1, 2, 0)}, 0);
  markers.add(robotNamed("Bob", 0.2));
  const Poses poses{mrpt::math::TPose2D(1, 2, 0), mrpt::math::TPose2D(7, 8, 0)};
  const auto array = ros::decode<ros::MarkerArray>(markers.message(poses, 1));
  ASSERT_EQ(array.markers.size(), 4u);
  EXPECT_EQ(array.markers[2].pose.position.x, 7);
}

}  // namespace
}  // namespace robosim
