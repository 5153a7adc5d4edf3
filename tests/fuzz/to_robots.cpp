// What an environment sends to robots: the welcome, and readings.
#include "net/robot_wire.h"
#include "tests/fuzz/fuzz.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzzMessage<wire::ToRobots>(data, size, [](const wire::ToRobots& message) {
    const RobotsWelcome welcome = decode(message.welcome());
    for (int i = 0; i < message.robots_size() && i < static_cast<int>(welcome.seats.size()); ++i) {
      const RobotInfo& info = welcome.seats[static_cast<std::size_t>(i)].info;
      Readings readings = blankReadings(*info.sensors);
      decode(message.robots(i), info.name, readings);
      wire::RobotReadings again;
      encode(readings, again);
    }
  });
}
