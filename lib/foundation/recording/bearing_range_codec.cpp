#include <cmath>

#include <mrpt/obs/CObservationBearingRange.h>

#include "hardware/numbered_quantities.h"
#include "recording/codecs.h"

namespace robosim {
namespace {

/// Range and bearing: CObservationBearingRange with the neighbours that are measured; `landmarkID` is the index of the
/// robot in the world.
class BearingRangeCodec : public CodecOf<mrpt::obs::CObservationBearingRange, Values> {
 public:
  bool encodes(const SensorInfo& sensor) const override {
    const std::size_t count = sensor.quantities.size() / 3;
    return sensor.kind == SensorKind::values && count > 0 && sensor.quantities == neighbourQuantities(count);
  }

 private:
  void init(Observation& observation, const SensorInfo& sensor) const override {
    observation.fieldOfView_yaw = static_cast<float>(2 * M_PI);
    observation.fieldOfView_pitch = 0;
    observation.maxSensorDistance = static_cast<float>(sensor.range_max_m);
    observation.sensor_std_range = static_cast<float>(sensor.noise_std_m);
    observation.sensor_std_yaw = static_cast<float>(sensor.bearing_std_rad);
    observation.sensorLocationOnRobot = mrpt::poses::CPose3D(mountOf(sensor));
  }
  void set(Observation& observation, const SensorInfo&, const Values& measured, float) const override {
    observation.sensedData.clear();
    for (std::size_t i = 0; i + 2 < measured.values.size(); i += 3) {
      if (measured.values[i] < 0) continue;
      auto& sensed = observation.sensedData.emplace_back();
      sensed.landmarkID = static_cast<std::int32_t>(measured.values[i]);
      sensed.range = static_cast<float>(measured.values[i + 1]);
      sensed.yaw = static_cast<float>(measured.values[i + 2]);
      sensed.pitch = 0;
    }
  }
  Values get(const Observation& observation, const SensorInfo& sensor, float) const override {
    Values measured;
    for (const auto& sensed : observation.sensedData) {
      if (sensed.landmarkID < 0 || !std::isfinite(sensed.range) || !std::isfinite(sensed.yaw)) {
        refuse(observation, sensor, "a neighbour has no number, or its range or bearing is not finite");
      }
      const double values[] = {static_cast<double>(sensed.landmarkID), static_cast<double>(sensed.range),
                               static_cast<double>(sensed.yaw)};
      measured.values.insert(measured.values.end(), std::begin(values), std::end(values));
    }
    if (measured.values.size() > sensor.quantities.size()) refuse(observation, sensor, "it has too many neighbours");
    while (measured.values.size() < sensor.quantities.size()) {
      measured.values.push_back(measured.values.size() % 3 == 0 ? -1 : 0);
    }
    return measured;
  }
  bool append(const Observation& observation, ObservedNumbers& all) const override {
    for (const auto& sensed : observation.sensedData) {
      if (sensed.landmarkID < 0) continue;  // unknown to the program that recorded it
      const auto robot = static_cast<std::size_t>(sensed.landmarkID);
      all.push_back({"range", robot, kMetre, sensed.range, true});
      all.push_back({"bearing", robot, kRadian, sensed.yaw, true});
      // A sensor of the plane has none.
      if (observation.fieldOfView_pitch != 0 || sensed.pitch != 0) {
        all.push_back({"pitch", robot, kRadian, sensed.pitch, true});
      }
    }
    return true;
  }
};

}  // namespace

const Codec& bearingRangeCodec() { return theCodec<BearingRangeCodec>(); }

}  // namespace robosim
