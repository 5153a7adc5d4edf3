#include "aria/range_devices.h"

namespace robosim {

void RangeDevices::add(RangeDevice& device, PioneerRobot& robot) {
  if (has(device)) return;
  device.setRobot(&robot);
  devices_.push_back(&device);
}

bool RangeDevices::rem(const RangeDevice& device) {
  const auto found = std::find(devices_.begin(), devices_.end(), &device);
  if (found == devices_.end()) return false;
  (*found)->setRobot(nullptr);
  devices_.erase(found);
  return true;
}

bool RangeDevices::has(const RangeDevice& device) const {
  return std::find(devices_.begin(), devices_.end(), &device) != devices_.end();
}

RangeDevice* RangeDevices::find(const std::string& name) const {
  for (RangeDevice* device : devices_) {
    if (device->getName() == name) return device;
  }
  return nullptr;
}

void RangeDevices::update() {
  for (RangeDevice* device : devices_) device->update();
}

void RangeDevices::applyTransform(const PioneerTransform& transform, bool do_cumulative) {
  for (RangeDevice* device : devices_) device->applyTransform(transform, do_cumulative);
}

double RangeDevices::maxRange(double if_none) const {
  double range = if_none;
  for (const RangeDevice* device : devices_) {
    range = device == devices_.front() ? device->getMaxRange() : std::min(range, device->getMaxRange());
  }
  return range;
}

}  // namespace robosim
