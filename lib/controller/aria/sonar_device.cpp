#include "aria/sonar_device.h"

#include "aria/pioneer_robot.h"

namespace robosim {
namespace {

constexpr double kSonarMaxRange_mm = 5000;
constexpr double kSonarCumulativeGap_mm = 50;
constexpr double kSonarKeepCumulative_mm = 3000;

}  // namespace

SonarDevice::SonarDevice(std::size_t current_size, std::size_t cumulative_size, std::string name)
    : RangeDevice(current_size, cumulative_size, std::move(name), kSonarMaxRange_mm) {
  setMaxDistToKeepCumulative(kSonarKeepCumulative_mm);
}

void SonarDevice::addReading(double x, double y) {
  current().addReading({x, y, now()});
  cumulative().replaceNear({x, y, now()}, kSonarCumulativeGap_mm);
}

void SonarDevice::processReadings(PioneerRobot& robot) {
  for (int i = 0; i < robot.getNumSonar(); ++i) {
    if (!robot.isSonarNew(i) || !robot.hasSonarEcho(i)) continue;
    const auto reading = robot.getSonarReading(i);
    addReading(reading->getX(), reading->getY());
  }
}

}  // namespace robosim
