#include "sensors/lidar.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/portable_math.h"
#include "hardware/lidar_range.h"
#include "sensors/beam_echoes.h"
#include "sensors/beam_mounts.h"
#include "sensors/raycast/layer_fan.h"
#include "sensors/scan_errors.h"
#include "sensors/swept_pose.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;

/// Velodyne VLP-16, "typical accuracy ±3 cm" (User Manual 63-9243), taken for one standard deviation.
constexpr double kLidarStd_m = 0.03;

/// Azimuth of each beam of a layer, robot frame.
std::vector<double> azimuthsOf(const LidarOptions& o) {
  std::vector<double> azimuths_rad;
  for (int i = 0; i < o.beams; ++i) {
    azimuths_rad.push_back(o.direction_rad + o.field_of_view_rad * ((i + 0.5) / o.beams - 0.5));
  }
  return azimuths_rad;
}

std::vector<double> elevationsOf(const LidarOptions& o) {
  if (o.layers == 1) return {(o.elevation_min_rad + o.elevation_max_rad) / 2};
  std::vector<double> elevations_rad;
  for (int i = 0; i < o.layers; ++i) {
    elevations_rad.push_back(o.elevation_min_rad +
                             (o.elevation_max_rad - o.elevation_min_rad) * (static_cast<double>(i) / (o.layers - 1)));
  }
  return elevations_rad;
}

std::vector<TPoint2D> directionsOf(const LidarOptions& o) {
  std::vector<TPoint2D> directions;
  for (const double azimuth_rad : azimuthsOf(o)) {
    const auto [sin, cos] = portable::sincos(azimuth_rad);
    directions.emplace_back(cos, sin);
  }
  return directions;
}

SensorInfo infoOf(const LidarOptions& o) {
  SensorInfo info{.kind = SensorKind::lidar,
                  .label = o.label,
                  .beams = {},
                  .range_min_m = static_cast<double>(roundedLidarRange(o.range_min_m)),
                  .range_max_m = o.range_max_m,
                  .no_echo_m = o.no_return_m,
                  .noise_std_m = o.errors.largestStd(o.range_max_m),
                  .times = o.timing.times};
  const TPoint3D& at = o.robot_from_lidar;
  const auto azimuths_rad = azimuthsOf(o);
  for (const double elevation_rad : elevationsOf(o)) {
    // MRPT's pitch is positive downwards.
    for (const double azimuth_rad : azimuths_rad)
      info.beams.push_back({{at.x, at.y, at.z, azimuth_rad, -elevation_rad, 0}});
  }
  return info;
}

/// Scan of one robot.
struct LidarScan {
  std::vector<double> distance_m;  ///< by beam
  std::vector<LayerFan::Column> moved;
};

class Lidar : public Sensor {
 public:
  explicit Lidar(const LidarOptions& o)
      : info_(infoOf(o)),
        origin_(o.robot_from_lidar),
        directions_(directionsOf(o)),
        fan_(directions_, elevationsOf(o), o.range_max_m),
        is_random_(o.errors.isRandom()),
        errors_(o.errors, info_),
        timing_(o.timing) {
    for (const auto& beam : info_.beams) fields_.add({originOf(beam), directionOf(beam)});
  }

  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return is_random_ || timing_.latency_std_s > 0; }
  bool needsHostProcess() const override { return timing_.times.rate_hz > 0; }
  bool usesNeighbours() const override { return false; }
  double robotReach(double speed_max_mps) const override {
    // A scan's age that is distributed normally has no limit.
    if (timing_.latency_std_s > 0) return Sensor::robotReach(speed_max_mps);
    return beamReach(info_) + speed_max_mps * (timing_.sweep_s + timing_.latency_s);
  }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    if (!timing_.times.isDue(now.time)) return;
    static thread_local LidarScan scan;  // reused for all robots of a thread
    scan.distance_m.resize(info_.beams.size());
    for (const auto robot : robots) {
      cast(now, robot, slot, scan);
      if (!errors_.areNone()) {
        errors_.apply(now, robot, slot, scan.distance_m,
                      [&](std::size_t i, const auto&) { return Return{scan.distance_m[i]}; });
      }
      for (double& distance_m : scan.distance_m) distance_m = static_cast<double>(roundedLidarRange(distance_m));
      setEchoes(fields_, EchoRule(info_), scan.distance_m, std::get<Echoes>(readings[robot].measurements[slot]));
    }
  }

 private:
  void cast(const Snapshot& now, std::uint32_t robot, std::size_t slot, LidarScan& scan) const {
    const PlanarTransform& robot_frame = now.frames[robot];
    const TPoint3D origin = robot_frame.pointToWorld(origin_);
    const ViewFrame view{origin.x, origin.y, origin.z, robot_frame.cos(), robot_frame.sin()};
    const Motion& motion = now.last_motion[robot];
    const bool has_moved = motion.length_m != 0 || motion.turn_rad != 0 || motion.lateral_m != 0;
    const double latency_s = has_moved ? timing_.drawLatency(now, robot, slot, info_.beams.size()) : 0;
    if (!has_moved || (timing_.sweep_s == 0 && latency_s == 0)) {
      return fan_.cast(now.scene, view, now.bodyOf(robot), scan.distance_m);
    }
    const auto last = static_cast<double>(std::max<std::size_t>(directions_.size() - 1, 1));
    const double oldest = (latency_s + timing_.sweep_s) / now.time.period_s;
    const double step = timing_.sweep_s / last / now.time.period_s;
    double spread_m = 0;
    scan.moved.resize(directions_.size());
    const auto place = [&](auto pose) {
      for (std::size_t i = 0; i < directions_.size(); ++i, pose.next()) {
        const TPoint3D at = pose.pointToWorld(origin_);
        const TPoint3D way = pose.turnToWorld(TPoint3D(directions_[i].x, directions_[i].y, 0));
        LayerFan::Column& column = scan.moved[i];
        column = {view.toView({at.x - view.x, at.y - view.y}), view.toView({way.x, way.y})};
        spread_m = std::max(spread_m, std::abs(column.origin.x) + std::abs(column.origin.y));
      }
    };
    if (motion.lateral_m == 0) {
      place(SweptPose(robot_frame, motion, oldest, step));
    } else {
      place(SweptPoseAside(robot_frame, motion, oldest, step));
    }
    fan_.castMoved(now.scene, view, scan.moved, spread_m, now.bodyOf(robot), scan.distance_m);
  }

  SensorInfo info_;
  TPoint3D origin_;                   ///< robot frame
  std::vector<TPoint2D> directions_;  ///< of the columns, robot frame
  LayerFan fan_;
  bool is_random_;
  ScanErrors errors_;
  LaserTiming timing_;
  BeamFields fields_;
};

int readCount(XmlReader& reader, const char* setting, double max, int otherwise) {
  const double count = reader.number(setting, {1, max}, otherwise);
  if (count != std::floor(count)) reader.errorAt(setting, "must be a whole number");
  return static_cast<int>(count);
}

void readErrors(XmlReader& reader, LaserErrors& errors) {
  auto element = reader.child("noise");
  if (!element) return;
  LaserErrors data_sheet;
  data_sheet.std_m = kLidarStd_m;
  errors = LaserErrors::read(*element, data_sheet);
  if (errors.divergence_rad > 0) element->errorAt("divergence_deg", "is for scanners with one layer; drop it");
  if (errors.reach_m > 0) element->errorAt("reach_m", "is for scanners with one layer; drop it");
  element->finish();
}

}  // namespace

LidarOptions LidarOptions::read(XmlReader& reader) {
  LidarOptions o;
  o.label = reader.word("label", o.label);
  o.robot_from_lidar = readPosition(reader);
  o.direction_rad = reader.angle("angle_deg", {-360, 360}, 0);
  o.layers = readCount(reader, "layers", 128, o.layers);
  o.beams = readCount(reader, "beams", 4096, o.beams);
  if (static_cast<std::size_t>(o.layers) * static_cast<std::size_t>(o.beams) > ScanErrors::kBeamsMax) {
    reader.errorAt("beams", "makes " + std::to_string(o.layers * o.beams) + " in all layers, of at most " +
                                std::to_string(ScanErrors::kBeamsMax) + "; use fewer beams or layers");
    o.beams = 1;
  }
  o.field_of_view_rad = reader.angle("field_of_view_deg", Bounds::positive(360), o.field_of_view_rad);
  constexpr double kElevationMax_deg = 89;
  o.elevation_min_rad = reader.angle("elevation_min_deg", {-kElevationMax_deg, kElevationMax_deg}, o.elevation_min_rad);
  o.elevation_max_rad = reader.angle("elevation_max_deg", {-kElevationMax_deg, kElevationMax_deg}, o.elevation_max_rad);
  if (o.elevation_max_rad < o.elevation_min_rad) {
    reader.errorAt("elevation_max_deg", "is below elevation_min_deg; the layers lie between both");
  }
  o.range_max_m = reader.number("range_max_m", Bounds::positive(1000), o.range_max_m);
  o.range_min_m = reader.number("range_min_m", Bounds::notNegative(o.range_max_m), 0);
  o.no_return_m = reader.number("no_return_m", {o.range_max_m, 10000}, o.range_max_m);
  readErrors(reader, o.errors);
  o.timing.read(reader);
  return o;
}

std::unique_ptr<Sensor> makeLidar(const LidarOptions& options) { return std::make_unique<Lidar>(options); }

}  // namespace robosim
