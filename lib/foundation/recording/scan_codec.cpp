#include <cassert>

#include <mrpt/obs/CObservation2DRangeScan.h>

#include "hardware/scan_geometry.h"
#include "recording/codecs.h"
#include "recording/echo_ranges.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation2DRangeScan;
using mrpt::poses::CPose3D;

/// Laser with two or more evenly spaced beams of common origin: CObservation2DRangeScan; no echo is an invalid range.
class ScanCodec : public CodecOf<CObservation2DRangeScan, Echoes> {
 public:
  bool encodes(const SensorInfo& sensor) const override {
    return sensor.kind == SensorKind::laser && toScanGeometry(sensor.beams).has_value();
  }

 private:
  void init(CObservation2DRangeScan& scan, const SensorInfo& sensor) const override {
    const ScanGeometry geometry = *toScanGeometry(sensor.beams);
    scan.aperture = static_cast<float>(geometry.aperture_rad);
    scan.rightToLeft = geometry.step_rad > 0;
    scan.maxRange = static_cast<float>(sensor.range_max_m);
    scan.sensorPose = CPose3D(geometry.robot_from_middle);
    scan.beamAperture = static_cast<float>(sensor.beam_width_rad);
    // A noiseless scanner keeps MRPT's 1 cm: an error of 0 would make every likelihood 0.
    if (sensor.noise_std_m > 0) scan.stdError = static_cast<float>(sensor.noise_std_m);
    scan.resizeScanAndAssign(sensor.beams.size(), static_cast<float>(sensor.no_echo_m), false);
  }

  void set(CObservation2DRangeScan& scan, const SensorInfo& sensor, const Echoes& echoes,
           float pan_rad) const override {
    assert(echoes.size() == scan.getScanSize());
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      scan.setScanRange(i, echoes[i].range_m);
      scan.setScanRangeValidity(i, !isNoEcho(sensor, echoes[i].range_m));
    }
    if (sensor.pans) scan.sensorPose = CPose3D(panned(toScanGeometry(sensor.beams)->robot_from_middle, pan_rad));
  }

  Echoes get(const CObservation2DRangeScan& scan, const SensorInfo& sensor, float pan_rad) const override {
    checkSize(scan, sensor, scan.getScanSize(), sensor.beams.size());
    Echoes echoes;
    for (std::size_t i = 0; i < sensor.beams.size(); ++i) {
      const bool is_valid = scan.getScanRangeValidity(i);
      echoes.push_back(
          echoAlong(sensor, i, pan_rad, is_valid ? scan.getScanRange(i) : static_cast<float>(sensor.no_echo_m)));
    }
    return echoes;
  }

  bool append(const CObservation2DRangeScan& scan, ObservedNumbers& all) const override {
    for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
      all.push_back(observedRange(i, scan.getScanRange(i), scan.getScanRangeValidity(i)));
    }
    return true;
  }
};

}  // namespace

const Codec& scanCodec() { return theCodec<ScanCodec>(); }

}  // namespace robosim
