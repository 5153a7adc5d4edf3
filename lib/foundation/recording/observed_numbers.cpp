#include "recording/observed_numbers.h"

#include <mrpt/obs/CObservationGPS.h>

#include "recording/codecs.h"

namespace robosim {
namespace {

/// @returns whether there are any
bool appendPosition(const mrpt::obs::CObservationGPS& gps, ObservedNumbers& all) {
  const std::size_t before = all.size();
  const bool has_fix = gps.hasMsgClass<mrpt::obs::gnss::Message_NMEA_GGA>();
  if (has_fix) {
    // Of a packed struct: + copies a number, which a reference to it could not be aligned for.
    const auto& at = gps.getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields;
    all.push_back({"latitude", {}, kDegree, +at.latitude_degrees});
    all.push_back({"longitude", {}, kDegree, +at.longitude_degrees});
    all.push_back({"altitude", {}, kMetre, +at.altitude_meters});
    all.push_back({"fix_quality", {}, kNoUnit, static_cast<double>(at.fix_quality)});
    all.push_back({"satellites", {}, kNoUnit, static_cast<double>(at.satellitesUsed)});
    if (at.thereis_HDOP) all.push_back({"hdop", {}, kNoUnit, +at.HDOP});
  }
  if (gps.hasMsgClass<mrpt::obs::gnss::Message_NMEA_RMC>()) {
    constexpr double kMetresPerSecondOfKnot = 1852.0 / 3600;
    const auto& moves = gps.getMsgByClass<mrpt::obs::gnss::Message_NMEA_RMC>().fields;
    if (!has_fix) {
      all.push_back({"latitude", {}, kDegree, +moves.latitude_degrees});
      all.push_back({"longitude", {}, kDegree, +moves.longitude_degrees});
    }
    all.push_back({"speed", {}, kMetrePerSecond, moves.speed_knots * kMetresPerSecondOfKnot});
    all.push_back({"course", {}, kDegree, +moves.direction_degrees});
  }
  return all.size() > before;
}

}  // namespace

std::string ObservedNumber::fullName() const {
  std::string text = name;
  if (index) text += "_" + std::to_string(*index);
  if (*unit.suffix) text += std::string("_") + unit.suffix;
  return text;
}

std::optional<ObservedNumbers> numbersIn(const mrpt::obs::CObservation& observation) {
  ObservedNumbers numbers;
  for (const Codec* codec : codecs()) {
    if (codec->appendNumbers(observation, numbers)) return numbers;
  }
  const auto* gps = dynamic_cast<const mrpt::obs::CObservationGPS*>(&observation);
  if (gps && appendPosition(*gps, numbers)) return numbers;
  return std::nullopt;
}

}  // namespace robosim
