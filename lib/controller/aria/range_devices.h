#pragma once
#include <optional>
#include <string>
#include <vector>

#include "aria/range_device.h"

namespace robosim {

/// The closest point of several range devices.
struct ClosestOfDevices {
  std::optional<ClosestPoint> point;
  const RangeDevice* device = nullptr;  ///< that has it
};

/// The range devices of one robot.
class RangeDevices {
 public:
  /// @param device must outlive its entry. Adding a device again has no effect.
  void add(RangeDevice& device, PioneerRobot& robot);
  bool rem(const RangeDevice& device);
  bool has(const RangeDevice& device) const;
  RangeDevice* find(const std::string& name) const;  ///< null when there is none
  const std::vector<RangeDevice*>& list() const { return devices_; }
  void update();
  void applyTransform(const PioneerTransform& transform, bool do_cumulative);
  /// The smallest maximum range of the devices [mm]; `if_none` without devices.
  double maxRange(double if_none) const;

  /// The closest of all devices' closest points; points beyond a device's maximum range do not count.
  /// @param query returns the closest point of a device's buffer
  template <typename Query>
  ClosestOfDevices closest(const Query& query) const {
    ClosestOfDevices best;
    for (const RangeDevice* device : devices_) {
      const std::optional<ClosestPoint> point = query(*device);
      if (!point || point->distance > device->getMaxRange()) continue;
      if (!best.point || point->distance < best.point->distance) best = {point, device};
    }
    return best;
  }

 private:
  std::vector<RangeDevice*> devices_;  ///< in the order in which they were added
};

}  // namespace robosim
