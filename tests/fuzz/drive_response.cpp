// Fuzzes the messages of an environment to robots: the welcome, and readings.
#include "net/robot_wire.h"
#include "tests/fuzz/fuzz.h"

using namespace robosim;

namespace {

/// A sensor of each kind of measurement.
std::vector<SensorInfo> everySensor() {
  std::vector<SensorInfo> sensors;
  for (const auto kind : {SensorKind::sonar, SensorKind::heat, SensorKind::bumper, SensorKind::odometry,
                          SensorKind::camera, SensorKind::blob_finder, SensorKind::beacons, SensorKind::values}) {
    SensorInfo sensor;
    sensor.kind = kind;
    sensor.label = nameOf(kind);
    sensor.beams.resize(2);
    sensor.colors = {"gold"};
    sensor.quantities = {{"co2", "ppm"}};
    sensors.push_back(sensor);
  }
  return sensors;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzzMessage<v1::DriveResponse>(data, size, [](const v1::DriveResponse& message) {
    if (message.has_welcome()) {
      decode(message.welcome());
      return;
    }
    for (const auto& received : message.readings().robots()) {
      Readings readings = blankReadings(everySensor());
      readings.time.step = message.readings().step();
      decode(received, "Robo", readings);
      v1::RobotReadings again;
      encode(readings, again);
    }
  });
}
