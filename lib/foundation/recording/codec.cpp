#include "recording/codec.h"

#include "hardware/added_codecs.h"
#include "recording/codecs.h"
#include "recording/recording_error.h"

namespace robosim {

std::vector<const Codec*> codecs() {
  std::vector<const Codec*> all = addedCodecs();
  all.insert(all.end(), {
                            &scanCodec(),          // CObservation2DRangeScan: lasers with evenly spaced beams
                            &lidarCodec(),         // CObservation3DRangeScan
                            &rangeCodec(),         // CObservationRange: all other sensors that measure echoes
                            &heatCodec(),          // CObservationGasSensors
                            &compassCodec(),       // CObservationIMU
                            &batteryCodec(),       // CObservationBatteryState
                            &bumperCodec(),        // CObservationRawDAQ
                            &odometryCodec(),      // CObservationOdometry
                            &raycastImageCodec(),  // CObservationImage: ray-cast cameras of colours only
                            &raycastDepthCodec(),  // CObservation3DRangeScan: other ray-cast cameras
                            &imageCodec(),         // CObservationImage: all other cameras
                            &blobCodec(),          // CObservationRawDAQ
                            &beaconCodec(),        // CObservationBeaconRanges
                            &bearingRangeCodec(),  // CObservationBearingRange: range_and_bearing
                            &gnssCodec(),          // CObservationGPS
                            &inertialCodec(),      // CObservationIMU: imu
                            &valuesCodec(),        // CObservationRawDAQ: all other values
                        });
  return all;
}

void refuse(const mrpt::obs::CObservation& observation, const SensorInfo& sensor, const std::string& why) {
  throw RecordingError("recorded observation \"" + observation.sensorLabel + "\" (" +
                       observation.GetRuntimeClass()->className + ") is not of the " + nameOf(sensor.kind) + " \"" +
                       sensor.label + "\": " + why + "; give the robots that the recording was made with");
}

void checkSize(const mrpt::obs::CObservation& observation, const SensorInfo& sensor, std::size_t recorded,
               std::size_t expected) {
  if (recorded == expected) return;
  refuse(observation, sensor,
         "it holds " + std::to_string(recorded) + " values in place of " + std::to_string(expected));
}

mrpt::math::TPose3D mountOf(const SensorInfo& sensor) {
  return sensor.beams.empty() ? mrpt::math::TPose3D::Identity() : sensor.beams[0].robot_from_beam;
}

const Codec& findCodec(const SensorInfo& sensor) {
  for (const Codec* codec : codecs()) {
    if (codec->encodes(sensor)) return *codec;
  }
  throw std::logic_error(std::string("no codec records the kind of sensor ") + nameOf(sensor.kind));
}

}  // namespace robosim
