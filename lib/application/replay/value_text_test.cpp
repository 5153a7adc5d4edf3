#include "replay/value_text.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationRawDAQ.h>

#include "replay/recorded_sensors.h"

namespace robosim {
namespace {

mrpt::obs::CObservationRawDAQ inputs(std::vector<double> numbers) {
  mrpt::obs::CObservationRawDAQ daq;
  daq.sensorLabel = "Rover/sensor";
  daq.AIN_double = std::move(numbers);
  return daq;
}

TEST(ValueText, OfASensorOfQuantitiesNamesThem) {
  SensorInfo air;
  air.kind = SensorKind::values;
  for (const char* name : {"a", "b", "c", "d", "e", "f"}) air.quantities.push_back({name, "ppm"});
  air.quantities.push_back({"g", ""});
  EXPECT_EQ(inWords(inputs({1, 2, 3, 4, 5, 6, 7.5}), &air),
            "a 1.000 ppm, b 2.000 ppm, c 3.000 ppm, d 4.000 ppm, e 5.000 ppm, f 6.000 ppm, g 7.500");
}

TEST(ValueText, OfABlobFinderNamesItsColors) {
  SensorInfo finder;
  finder.kind = SensorKind::blob_finder;
  finder.colors = {"gold", "red"};
  EXPECT_EQ(inWords(inputs({120, 3.5, 4, 1, 2, 5, 6, 0, 0, 0, 0, 0, 0, 0}), &finder),
            "gold 120 px at (3.5, 4.0); red 0 px");
}

TEST(ValueText, OfAnUndescribedSensorListsItsInputs) {
  EXPECT_EQ(inWords(inputs({1, 2, 3, 4, 5, 6, 7})), "inputs 1.000 2.000 3.000 4.000 5.000 6.000 7.000");
  SensorInfo other;
  other.kind = SensorKind::values;
  other.quantities = {{"a", "ppm"}};
  EXPECT_EQ(inWords(inputs({1, 2}), &other), "inputs 1.000 2.000");
}

TEST(ValueText, OfACommandNamesTheDevicesThatItMoves) {
  EXPECT_EQ(inWords(Command{.speed_mps = 0.25, .turn_radps = -1}), "0.250 m/s, -1.000 rad/s");
  EXPECT_EQ(
      inWords(Command{.camera_head = CameraHeadCommand{{0.5, 0, 2}, 1, 0.25}}),
      "0.000 m/s, 0.000 rad/s, camera to pan 0.500 rad, tilt 0.000 rad, zoom 2.000, camera at 1.000 and 0.250 rad/s");
  EXPECT_EQ(inWords(Command{.emergency_stop = true, .grip = true, .led_color = 0xff0000, .lateral_mps = 0.1}),
            "0.000 m/s, 0.000 rad/s, 0.100 m/s to the left, gripper closed, LEDs 0xff0000, emergency stop");
}

TEST(ValueText, OfBeaconsHasTheirIndices) {
  mrpt::obs::CObservationBeaconRanges beacons;
  for (const int beacon : {0, 2}) {
    auto& sensed = beacons.sensedData.emplace_back();
    sensed.beaconID = beacon;
    sensed.sensedDistance = static_cast<float>(beacon) + 5;
  }
  EXPECT_EQ(inWords(beacons), "0: 5.00 2: 7.00 m");
}

TEST(RecordedSensors, AreFoundByTheLabelsOfTheirObservations) {
  RobotInfo rover;
  rover.name = "Rover";
  SensorInfo sonar;
  sonar.label = "sonar";
  sonar.range_max_m = 5;
  rover.sensors = std::make_shared<std::vector<SensorInfo>>(1, sonar);
  const RecordedSensors sensors({rover});
  ASSERT_NE(sensors.find("Rover/sonar"), nullptr);
  EXPECT_EQ(sensors.find("Rover/sonar")->range_max_m, 5);
  EXPECT_EQ(sensors.find("Rover/sonar/POINTS"), nullptr);
  EXPECT_EQ(sensors.find("Other/sonar"), nullptr);
}

TEST(RecordedSensors, AreThoseOfTheWorldInTheRecording) {
  const RecordedSensors sensors = RecordedSensors::of(RunNote::of(ROBOSIM_SOURCE_DIR "/rawlogs/opho2_1.rawlog"));
  ASSERT_NE(sensors.find("Finder1/sonar"), nullptr);
  EXPECT_EQ(sensors.find("Finder1/sonar")->kind, SensorKind::sonar);
}

}  // namespace
}  // namespace robosim
