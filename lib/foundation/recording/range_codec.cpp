#include <algorithm>
#include <cassert>

#include <mrpt/obs/CObservationRange.h>

#include "hardware/scan_geometry.h"
#include "recording/codecs.h"
#include "recording/cone_aperture.h"
#include "recording/echo_ranges.h"

namespace robosim {
namespace {

using mrpt::obs::CObservationRange;

/// MRPT's grid maps reject a cone of width 0.
constexpr float kThinBeam_rad = 0.001f;

/// Sonar, infrared, and lasers that ScanCodec does not encode: CObservationRange, one for all beams; `sensorID` numbers
/// them. No echo is recordedNoEcho(). A panning sensor is recorded with its current pose.
class RangeCodec : public CodecOf<CObservationRange, Echoes> {
  void init(CObservationRange& range, const SensorInfo& sensor) const override {
    range.minSensorDistance = static_cast<float>(sensor.range_min_m);
    range.maxSensorDistance = static_cast<float>(sensor.range_max_m);
    coneAperture(range) = std::max(static_cast<float>(sensor.beam_width_rad), kThinBeam_rad);
    range.sensedData.resize(sensor.beams.size());
    for (std::size_t i = 0; i < sensor.beams.size(); ++i) {
      range.sensedData[i].sensorID = static_cast<std::uint16_t>(i);
      range.sensedData[i].sensorPose = sensor.beams[i].robot_from_beam;
    }
  }

  void set(CObservationRange& range, const SensorInfo& sensor, const Echoes& echoes, float pan_rad) const override {
    assert(echoes.size() == range.sensedData.size());
    const float no_echo_m = recordedNoEcho(sensor);
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      auto& sensed = range.sensedData[i];
      sensed.sensedDistance = isNoEcho(sensor, echoes[i].range_m) ? no_echo_m : echoes[i].range_m;
      if (sensor.pans) sensed.sensorPose = panned(sensor.beams[i].robot_from_beam, pan_rad);
    }
  }

  Echoes get(const CObservationRange& range, const SensorInfo& sensor, float pan_rad) const override {
    checkSize(range, sensor, range.sensedData.size(), sensor.beams.size());
    Echoes echoes;
    for (std::size_t i = 0; i < sensor.beams.size(); ++i) {
      const float range_m = range.sensedData[i].sensedDistance;
      const bool has_echo = range_m <= static_cast<float>(sensor.range_max_m);
      echoes.push_back(echoAlong(sensor, i, pan_rad, has_echo ? range_m : static_cast<float>(sensor.no_echo_m)));
    }
    return echoes;
  }

  std::vector<Number> numbers(CObservationRange& range) const override {
    std::vector<Number> numbers;
    for (const auto& sensed : range) numbers.push_back(bytesOf(sensed.sensedDistance));
    return numbers;
  }

  bool append(const CObservationRange& range, ObservedNumbers& all) const override {
    for (std::size_t i = 0; i < range.sensedData.size(); ++i) {
      const float range_m = range.sensedData[i].sensedDistance;
      all.push_back(observedRange(i, range_m, !(range_m > range.maxSensorDistance)));
    }
    return true;
  }
};

}  // namespace

const Codec& rangeCodec() { return theCodec<RangeCodec>(); }

}  // namespace robosim
