#include "recording/robot_status_record.h"

#include <gtest/gtest.h>

#include "base/label.h"
#include "recording/testing/sample_robot.h"

namespace robosim {
namespace {

TEST(RobotStatusRecord, RecordsPointsOnlyOfEchoesOffTheAxesOfTheirPannedBeams) {
  SensorInfo laser = rangeSensor(SensorKind::laser, "laser", {beamAt(0.2, 0, 0.3, 0)}, 8, 8);
  laser.pans = true;
  RobotInfo robot;
  robot.name = "rover";
  robot.sensors = std::make_shared<const std::vector<SensorInfo>>(std::vector<SensorInfo>{laser});
  RobotStatusRecord record(robot);
  Readings readings;
  readings.laser_pan_rad = 0.5F;
  const auto labels_with_point = [&](const mrpt::math::TPoint3Df& point_m) {
    readings.measurements = {Echoes{{2, point_m}}};
    std::vector<std::string> labels;
    for (const auto& observation : record.of(readings, {})) labels.push_back(observation->sensorLabel);
    return labels;
  };
  const auto on_axis = pointAlong(originOf(laser.beams[0]), directionOf(laser.beams[0], readings.laser_pan_rad), 2);
  const auto without_pan = pointAlong(originOf(laser.beams[0]), directionOf(laser.beams[0]), 2);
  const std::string status = Label{"rover", kStatus, ""}.text(), points = Label{"rover", "laser", kPoints}.text();
  EXPECT_EQ(labels_with_point(on_axis), std::vector{status});
  EXPECT_EQ(labels_with_point(without_pan), (std::vector{status, points}));
}

}  // namespace
}  // namespace robosim
