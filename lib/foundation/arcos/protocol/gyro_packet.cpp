#include "arcos/protocol/gyro_packet.h"

#include <algorithm>
#include <cmath>

#include "arcos/protocol/bytes.h"
#include "arcos/protocol/command.h"
#include "base/angle_units.h"

namespace robosim::arcos {
namespace {

constexpr double kFull = 1023, kFull_v = 5, kRest = 512;
constexpr double kRange_degps = 300, kRange_v = 2.5;
constexpr double kScale = 1.626;
constexpr int kReadings = 4;
constexpr std::uint8_t kTemperature = 25;

}  // namespace

std::string encodeGyro(double turn_radps) {
  const double counts_per_degps = kFull / kFull_v * kRange_v / kRange_degps / kScale;
  const double exact = std::clamp(kRest - toDegrees(turn_radps) * counts_per_degps, 0.0, kFull);
  ByteWriter bytes;
  bytes.add(std::uint8_t{kReadings});
  double sent = 0;
  for (int i = 1; i <= kReadings; ++i) {
    const double reading = std::round(i * exact) - sent;
    sent += reading;
    bytes.add(static_cast<std::uint16_t>(reading)).add(kTemperature);
  }
  return encode(packet_type::gyro, bytes.bytes());
}

}  // namespace robosim::arcos
