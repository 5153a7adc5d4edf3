#pragma once
#include "aria/range_device.h"

namespace robosim {

/// The robot's sonars as a range device, as ARIA's ArSonarDevice. Each step adds the echoes of all sonars that have
/// one. The current buffer has no limit of age: without echoes, a point remains until newer ones replace it. The
/// cumulative buffer contains points that are at least 50 mm apart, of which the newest is kept, within 3 m of the
/// robot.
class SonarDevice : public RangeDevice {
 public:
  explicit SonarDevice(std::size_t current_size = 24, std::size_t cumulative_size = 64, std::string name = "sonar");
  void addReading(double x, double y) override;

 protected:
  void processReadings(PioneerRobot& robot) override;
};

}  // namespace robosim
