#include "dds/names.h"

#include <gtest/gtest.h>

namespace robosim::dds {
namespace {

TEST(DdsNames, AreThoseOfRos2) {
  EXPECT_EQ(ddsTopicName("/robot1/scan"), "rt/robot1/scan");
  EXPECT_EQ(ddsTypeName("sensor_msgs/msg/LaserScan"), "sensor_msgs::msg::dds_::LaserScan_");
}

}  // namespace
}  // namespace robosim::dds
