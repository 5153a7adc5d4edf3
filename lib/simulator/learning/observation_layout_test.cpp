#include "learning/observation_layout.h"

#include <cmath>
#include <limits>
#include <memory>
#include <variant>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "hardware/measurement_fields.h"

namespace robosim {
namespace {

/// A robot with a sensor of each kind: two beams, one colour, one quantity.
RobotInfo robotWithAllSensors() {
  auto sensors = std::make_shared<std::vector<SensorInfo>>();
  for (std::size_t i = 0; i < kSensorKindNames.size(); ++i) {
    SensorInfo sensor;
    sensor.kind = static_cast<SensorKind>(i);
    sensor.label = kSensorKindNames[i];
    sensor.beams.resize(2);
    sensor.no_echo_m = 3;
    sensor.colors = {"red"};
    sensor.quantities = {{"co2", "ppm"}};
    sensors->push_back(sensor);
  }
  RobotInfo robot;
  robot.name = "r";
  robot.sensors = sensors;
  return robot;
}

TEST(ObservationLayout, HasTheNumbersOfTheDescriptionOfEveryKindOfSensor) {
  const RobotInfo robot = robotWithAllSensors();
  for (const SensorInfo& sensor : *robot.sensors) {
    SCOPED_TRACE(nameOf(sensor.kind));
    std::size_t numbers = 0;
    Measurement measurement = blankMeasurement(sensor);
    std::visit([&](auto& of) { forNumbers(of, [&](const auto&, auto&, std::size_t) { ++numbers; }); }, measurement);
    if (numbers == 0 || sensor.kind == SensorKind::unknown) {
      EXPECT_THROW(ObservationLayout(robot, {nameOf(sensor.kind)}), ConfigError);
      continue;
    }
    const ObservationLayout layout(robot, {nameOf(sensor.kind)});
    // Of an echo the range only; of odometry not the lateral speed.
    const std::size_t observed = sensor.kind == SensorKind::odometry ? numbers - 1 : numbers;
    EXPECT_EQ(layout.size(), measuresEchoes(sensor) ? 2u : observed);
    EXPECT_EQ(layout.parts()[0].low.size(), layout.size());
  }
}

TEST(ObservationLayout, WritesTheNumbersInTheirOrder) {
  const RobotInfo robot = robotWithAllSensors();
  State state;
  state.readings.resize(1);
  for (const SensorInfo& sensor : *robot.sensors) {
    float next = 1;
    Measurement measurement = blankMeasurement(sensor);
    std::visit(
        [&](auto& of) {
          forNumbers(of, [&](const auto&, auto& number, std::size_t) {
            number = static_cast<std::remove_reference_t<decltype(number)>>(next++);
          });
        },
        measurement);
    state.readings[0].measurements.push_back(measurement);
  }
  const ObservationLayout layout(robot, {"laser", "odometry", "beacons", "blob_finder"});
  std::vector<float> out(layout.size());
  layout.write(state, 0, out);
  EXPECT_EQ(out, (std::vector<float>{1, 5, 1, 2, 3, 4, 5, 1, 2, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(ObservationLayout, BoundsRangesHeadingsAndWhatTheFieldsBound) {
  const ObservationLayout layout(robotWithAllSensors(), {"sonar", "odometry", "bumper", "compass", "values"});
  const auto pi = static_cast<float>(M_PI);
  const float none = std::numeric_limits<float>::infinity();
  const auto parts = layout.parts();
  EXPECT_EQ(parts[0].high, (std::vector<float>{3, 3}));
  EXPECT_EQ(parts[0].low, (std::vector<float>{0, 0}));
  EXPECT_EQ(parts[1].high, (std::vector<float>{none, none, pi, none, none}));
  EXPECT_EQ(parts[2].high, (std::vector<float>{1, 1}));
  EXPECT_EQ(parts[3].low, (std::vector<float>{-pi}));
  EXPECT_EQ(parts[4].low, (std::vector<float>{-none}));
}

}  // namespace
}  // namespace robosim
