#include "recording/bag/bag_names.h"

#include <gtest/gtest.h>

#include "ros/messages.h"

namespace robosim {
namespace {

using Topics = std::vector<std::pair<std::string, std::string>>;
constexpr const char* kScan = ros::LaserScan::kType;
constexpr const char* kOdometry = ros::Odometry::kType;
constexpr const char* kRange = ros::Range::kType;
constexpr const char* kPicture = ros::CompressedImage::kType;

/// "robot/sensor" of each topic, with "#N" for a part.
std::vector<std::string> labels(const Topics& topics, const BagNamespaces& namespaces = {}) {
  std::vector<BagTopic> all;
  for (const auto& [name, type] : topics) all.push_back({name, type, "cdr"});
  std::vector<std::string> texts;
  for (const auto& name : bagNames(all, namespaces)) {
    texts.push_back(name.robot + "/" + name.sensor + (name.is_part ? "#" + std::to_string(name.part) : ""));
  }
  return texts;
}
using Labels = std::vector<std::string>;

TEST(BagNames, NamesSensorsAsRoboSimDoes) {
  EXPECT_EQ(labels({{"/scan", kScan}, {"/scan_2", kScan}, {"/front_lidar", kScan}, {"/odom", kOdometry}}),
            (Labels{"robot/laser", "robot/laser_2", "robot/front_lidar", "robot/odometry"}));
}

TEST(BagNames, TakesTheNamespaceAsTheRobot) {
  EXPECT_EQ(labels({{"/a/scan", kScan}, {"/b/scan", kScan}, {"/a/odom", kOdometry}, {"/b/ground_truth", kOdometry}}),
            (Labels{"a/laser", "b/laser", "a/odometry", "b/GROUND_TRUTH"}));
}

TEST(BagNames, DropsTheFormOfAPicture) {
  EXPECT_EQ(labels({{"/camera/image_raw/compressed", kPicture}, {"/rear/image", ros::Image::kType}}),
            (Labels{"robot/camera", "robot/rear"}));
  EXPECT_EQ(labels({{"/a/camera/image_raw/compressed", kPicture}}), Labels{"a/camera"});
}

TEST(BagNames, GathersTheRangesOfARing) {
  EXPECT_EQ(labels({{"/sonar/range_0", kRange}, {"/sonar/range_15", kRange}, {"/us_left", kRange}}),
            (Labels{"robot/sonar#0", "robot/sonar#15", "robot/us_left"}));
  EXPECT_EQ(labels({{"/a/sonar/range_3", kRange}, {"/a/sonar/range_x", kRange}}),
            (Labels{"a/sonar#3", "a/sonar_range_x"}));
}

TEST(BagNames, HasOneRobotWhereATopicHasNoNamespace) {
  const Topics topics{{"/scan", kScan}, {"/diff_drive_controller/odom", kOdometry}, {"/rear/scan", kScan}};
  EXPECT_EQ(labels(topics), (Labels{"robot/laser", "robot/diff_drive_controller_odom", "robot/rear_scan"}));
  BagNamespaces namespaces;
  namespaces.with_transforms = {"rear"};
  EXPECT_EQ(labels(topics, namespaces), (Labels{"robot/laser", "robot/diff_drive_controller_odom", "rear/laser"}));
}

TEST(BagNames, HasOneRobotWhereFramesAreSharedAndOneTopicIsOdometry) {
  BagNamespaces namespaces;
  namespaces.has_shared_frames = true;
  EXPECT_EQ(labels({{"/base/odom", kOdometry}, {"/lidar/scan", kScan}}, namespaces),
            (Labels{"robot/base_odom", "robot/lidar_scan"}));
  EXPECT_EQ(labels({{"/a/odom", kOdometry}, {"/b/odom", kOdometry}}, namespaces), (Labels{"a/odometry", "b/odometry"}));
  EXPECT_EQ(labels({{"/a/odom", kOdometry}, {"/a/scan", kScan}}, namespaces), (Labels{"a/odometry", "a/laser"}));
}

TEST(BagNames, GivesFurtherTopicsTheirWholeNames) {
  EXPECT_EQ(labels({{"/camera/image_raw", ros::Image::kType}, {"/camera/image_raw/compressed", kPicture}}),
            (Labels{"robot/camera", "robot/camera_image_raw_compressed"}));
}

TEST(BagNames, DoesNotGiveASensorAReservedLabel) {
  EXPECT_EQ(labels({{"/a/STATUS", kScan}, {"/a/GROUND_TRUTH", kScan}}), (Labels{"a/STATUS_", "a/GROUND_TRUTH_"}));
}

}  // namespace
}  // namespace robosim
