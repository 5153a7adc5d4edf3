#include <cassert>
#include <cmath>

#include <mrpt/obs/CObservation3DRangeScan.h>

#include "hardware/lidar_range.h"
#include "recording/codecs.h"
#include "recording/echo_ranges.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation3DRangeScan;

/// Lidar: the points of CObservation3DRangeScan, of the beams with an echo, in a frame at the beams' origin with the
/// robot's axes. The pixel of a point is its direction (x) and its layer (y).
class LidarCodec : public CodecOf<CObservation3DRangeScan, Echoes> {
 public:
  bool encodes(const SensorInfo& sensor) const override { return sensor.kind == SensorKind::lidar; }

 private:
  void init(CObservation3DRangeScan& scan, const SensorInfo& sensor) const override {
    const auto origin = originOf(sensor.beams.at(0));
    scan.sensorPose = mrpt::poses::CPose3D(origin.x, origin.y, origin.z, 0, 0, 0);
    scan.maxRange = static_cast<float>(sensor.range_max_m);
    if (sensor.noise_std_m > 0) scan.stdError = static_cast<float>(sensor.noise_std_m);
    scan.hasPoints3D = true;
  }

  void set(CObservation3DRangeScan& scan, const SensorInfo& sensor, const Echoes& echoes, float) const override {
    assert(echoes.size() == sensor.beams.size());
    const std::size_t columns = columnsOf(sensor);
    scan.resizePoints3DVectors(echoes.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      if (isNoEcho(sensor, echoes[i].range_m)) continue;
      const auto point = pointAlong({}, directionOf(sensor.beams[i]), echoes[i].range_m);
      scan.points3D_x[count] = point.x;
      scan.points3D_y[count] = point.y;
      scan.points3D_z[count] = point.z;
      scan.points3D_idxs_x[count] = static_cast<std::uint16_t>(i % columns);
      scan.points3D_idxs_y[count] = static_cast<std::uint16_t>(i / columns);
      ++count;
    }
    scan.resizePoints3DVectors(count);
  }

  Echoes get(const CObservation3DRangeScan& scan, const SensorInfo& sensor, float) const override {
    const std::size_t columns = columnsOf(sensor);
    Echoes echoes;
    for (std::size_t i = 0; i < sensor.beams.size(); ++i) {
      echoes.push_back(echoAlong(sensor, i, 0, static_cast<float>(sensor.no_echo_m)));
    }
    checkSize(scan, sensor, scan.points3D_idxs_x.size(), scan.points3D_x.size());
    checkSize(scan, sensor, scan.points3D_idxs_y.size(), scan.points3D_x.size());
    checkSize(scan, sensor, scan.points3D_y.size(), scan.points3D_x.size());
    checkSize(scan, sensor, scan.points3D_z.size(), scan.points3D_x.size());
    for (std::size_t n = 0; n < scan.points3D_x.size(); ++n) {
      const std::size_t beam = scan.points3D_idxs_y[n] * columns + scan.points3D_idxs_x[n];
      if (scan.points3D_idxs_x[n] >= columns || beam >= echoes.size()) {
        refuse(scan, sensor, "a point is of a beam that the sensor does not have");
      }
      const auto along = directionOf(sensor.beams[beam]);
      echoes[beam] = echoAlong(sensor, beam, 0,
                               roundedLidarRange(scan.points3D_x[n] * along.x + scan.points3D_y[n] * along.y +
                                                 scan.points3D_z[n] * along.z));
    }
    return echoes;
  }

  bool append(const CObservation3DRangeScan& scan, ObservedNumbers& all) const override {
    if (!scan.hasPoints3D) return false;
    for (std::size_t i = 0; i < scan.points3D_x.size(); ++i) {
      all.push_back(
          observedRange(i,
                        std::sqrt(scan.points3D_x[i] * scan.points3D_x[i] + scan.points3D_y[i] * scan.points3D_y[i] +
                                  scan.points3D_z[i] * scan.points3D_z[i]),
                        true));
    }
    return true;
  }

  /// Number of beams in a layer: of equal elevation.
  static std::size_t columnsOf(const SensorInfo& sensor) {
    std::size_t columns = 1;
    while (columns < sensor.beams.size() &&
           sensor.beams[columns].robot_from_beam.pitch == sensor.beams[0].robot_from_beam.pitch) {
      ++columns;
    }
    return columns;
  }
};

}  // namespace

const Codec& lidarCodec() { return theCodec<LidarCodec>(); }

}  // namespace robosim
