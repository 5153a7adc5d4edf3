#include "recording/robot_status_record.h"

#include <gtest/gtest.h>

#include "base/label.h"
#include "recording/byte_archive.h"
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

TEST(RobotStatusRecord, KeepsFlagsAndLedsOfCommands) {
  RobotInfo robot;
  robot.name = "rover";
  robot.sensors = std::make_shared<const std::vector<SensorInfo>>();
  RobotStatusRecord record(robot);
  for (const Command& command : {Command{}, Command{.by_driver = true, .grip = true, .led_color = 0xffffff},
                                 Command{.emergency_stop = true, .led_color = 1}}) {
    EXPECT_EQ(statusFrom(*record.of({}, command).front()).command, command);
  }
}

TEST(RobotStatusRecord, KeepsTheCommandOfACamerasHead) {
  SensorInfo head = plainSensor(SensorKind::values, "ptz");
  head.quantities = CameraAim::quantities();
  RobotInfo robot;
  robot.name = "rover";
  robot.sensors = std::make_shared<const std::vector<SensorInfo>>(std::vector<SensorInfo>{head});
  Readings readings;
  readings.measurements = {CameraAim{}.values()};
  const Command ahead{.speed_mps = 1, .camera_head = CameraHeadCommand{{0.5, -0.25, 4}, 1.5, 0.75}};
  Command aside = ahead;
  aside.lateral_mps = -0.5;
  for (const auto& [kind, command] : {std::pair(DriveKind::differential, ahead), std::pair(DriveKind::omni, aside)}) {
    robot.type.edit().drive.kind = kind;
    RobotStatusRecord record(robot);
    EXPECT_EQ(statusFrom(*record.of(readings, command).front()).command, command);
  }
}

TEST(RobotStatusRecord, WritesTheStatusOfEveryDriveByItsTemplateAsMrptDoes) {
  SensorInfo head = plainSensor(SensorKind::values, "ptz");
  head.quantities = CameraAim::quantities();
  const Command ahead{
      .speed_mps = 0.5, .turn_radps = -0.25, .laser_pan_rad = 0.125F, .by_driver = true, .led_color = 0x123456};
  Command aside = ahead;
  aside.lateral_mps = -0.75;
  for (const bool has_head : {false, true}) {
    for (const auto& [kind, command] : {std::pair(DriveKind::differential, ahead), std::pair(DriveKind::omni, aside)}) {
      RobotInfo robot;
      robot.name = "rover";
      robot.type.edit().drive.kind = kind;
      robot.sensors = std::make_shared<const std::vector<SensorInfo>>(has_head ? std::vector<SensorInfo>{head}
                                                                               : std::vector<SensorInfo>{});
      RobotStatusRecord record(robot);
      EXPECT_TRUE(record.hasStatusTemplate())
          << "head " << has_head << ", omnidirectional " << (kind == DriveKind::omni);
      Command changing = command;
      for (const std::uint64_t step : {1, 2}) {
        Readings readings;
        readings.time = {step, 0.1};
        readings.laser_pan_rad = 0.25F * static_cast<float>(step);
        readings.stalled = step == 2;
        if (has_head) {
          readings.measurements = {CameraAim{}.values()};
          changing.camera_head = CameraHeadCommand{{0.5, -0.25, 4}, 1.5, static_cast<double>(step)};
        }
        ByteArchive by_mrpt, by_template;
        for (const auto& observation : record.of(readings, changing)) by_mrpt << *observation;
        record.write(readings, changing, by_template);
        EXPECT_EQ(by_template.bytes, by_mrpt.bytes);
      }
    }
  }
}

}  // namespace
}  // namespace robosim
