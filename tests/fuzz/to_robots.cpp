// Fuzzes the messages of an environment to robots: the welcome, and readings.
#include "net/robot_wire.h"
#include "tests/fuzz/fuzz.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzzMessage<wire::DriveResponse>(data, size, [](const wire::DriveResponse& message) {
    const RobotsWelcome welcome = decode(message.welcome());
    for (int i = 0; i < message.robots_size() && i < static_cast<int>(welcome.robots.size()); ++i) {
      const RobotInfo& info = welcome.robots[static_cast<std::size_t>(i)].info;
      Readings readings = blankReadings(*info.sensors);
      decode(message.robots(i), info.name, readings);
      wire::RobotReadings again;
      encode(readings, again);
    }
  });
}
