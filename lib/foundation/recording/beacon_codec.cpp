#include <mrpt/obs/CObservationBeaconRanges.h>

#include "recording/codecs.h"

namespace robosim {
namespace {

/// Beacons: CObservationBeaconRanges with the beacons that are received; `beaconID` is their index.
class BeaconCodec : public CodecOf<mrpt::obs::CObservationBeaconRanges, BeaconRanges> {
  void set(Observation& observation, const SensorInfo& sensor, const BeaconRanges& beacons, float) const override {
    observation.maxSensorDistance = static_cast<float>(sensor.range_max_m);
    if (sensor.noise_std_m > 0) observation.stdError = static_cast<float>(sensor.noise_std_m);
    observation.sensedData.clear();
    for (std::size_t i = 0; i < beacons.range_m.size(); ++i) {
      if (beacons.range_m[i] >= observation.maxSensorDistance) continue;
      auto& sensed = observation.sensedData.emplace_back();
      sensed.sensorLocationOnRobot = mrpt::poses::CPoint3D(originOf(sensor.beams[i]));
      sensed.sensedDistance = beacons.range_m[i];
      sensed.beaconID = static_cast<std::int32_t>(i);
    }
  }
  BeaconRanges get(const Observation& observation, const SensorInfo& sensor, float) const override {
    BeaconRanges beacons = Description<BeaconRanges>::blank(sensor);
    for (const auto& sensed : observation.sensedData) {
      const auto index = static_cast<std::size_t>(sensed.beaconID);
      if (index >= beacons.range_m.size()) refuse(observation, sensor, "it has a beacon of another number");
      if (!(sensed.sensedDistance >= 0 && sensed.sensedDistance <= static_cast<float>(sensor.no_echo_m))) {
        refuse(observation, sensor, "a range to a beacon is impossible");
      }
      beacons.range_m[index] = sensed.sensedDistance;
    }
    return beacons;
  }
  bool append(const Observation& observation, ObservedNumbers& all) const override {
    for (const auto& sensed : observation.sensedData) {
      if (sensed.beaconID < 0) continue;  // unknown to the program that recorded it
      all.push_back({"range", static_cast<std::size_t>(sensed.beaconID), kMetre, sensed.sensedDistance, true});
    }
    return true;
  }
};

}  // namespace

const Codec& beaconCodec() { return theCodec<BeaconCodec>(); }

}  // namespace robosim
