// Fuzzes the decoding of messages of ROS 2 (CDR) and what becomes of them: a byte that selects the type, then a
// message.
#include <stdexcept>

#include "recording/bag/bag_observations.h"
#include "ros/cdr.h"
#include "tests/fuzz/fuzz.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span<const std::uint8_t> message(data + 1, size - 1);
  const BagUseRow& row = bagUses()[data[0] % bagUses().size()];
  try {
    if (row.use == BagUse::transforms) {
      ros::decode<ros::TFMessage>(message);
    } else if (row.use == BagUse::camera_info) {
      ros::decode<ros::CameraInfo>(message);
    } else {
      const BagHeader header = bagHeaderOf(row.type, message);
      timestampOf(header.stamp_ns);
      if (!bagObservation({row.type, "robot/sensor", {}, 0, {}}, message)) throw std::logic_error("no observation");
    }
  } catch (const std::runtime_error&) {
  }
  return 0;
}
