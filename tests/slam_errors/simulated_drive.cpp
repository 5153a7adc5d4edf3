#include "tests/slam_errors/simulated_drive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "base/xml_parser.h"
#include "sensors/registry.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;

/// The arc that leads to a pose: its chord, with the sign of the direction of travel, and its turn.
Motion arcTo(const TPose2D& from, const TPose2D& to) {
  const TPose2D moved = to - from;
  const double turn_rad = std::remainder(moved.phi, 2 * M_PI);
  const double chord_m = std::copysign(std::hypot(moved.x, moved.y), moved.x);
  const double half = turn_rad / 2;
  return {chord_m * (half == 0 ? 1 : half / std::sin(half)), turn_rad};
}

TPose2D after(const TPose2D& from, const Motion& motion) {
  const double half = motion.turn_rad / 2;
  const double chord_m = motion.length_m * (half == 0 ? 1 : std::sin(half) / half);
  return from + TPose2D(chord_m * std::cos(half), chord_m * std::sin(half), motion.turn_rad);
}

std::vector<Motion> motionsOf(const std::vector<TPose2D>& path) {
  std::vector<Motion> motions(1);
  for (std::size_t k = 1; k < path.size(); ++k) motions.push_back(arcTo(path[k - 1], path[k]));
  return motions;
}

/// The pose of a path a time after that of each of its poses, on the arcs between them; at most the last one.
/// @param durations_s of the motion to each pose
std::vector<TPose2D> laterPoses(const std::vector<TPose2D>& path, const std::vector<double>& durations_s,
                                double later_s) {
  const std::vector<Motion> motions = motionsOf(path);
  std::vector<TPose2D> later;
  for (std::size_t k = 0; k < path.size(); ++k) {
    double rest_s = later_s;
    std::size_t at = k;
    while (at + 1 < path.size() && rest_s >= durations_s[at + 1]) rest_s -= durations_s[++at];
    if (at + 1 == path.size()) {
      later.push_back(path.back());
      continue;
    }
    const double share = rest_s / durations_s[at + 1];
    later.push_back(after(path[at], {share * motions[at + 1].length_m, share * motions[at + 1].turn_rad}));
  }
  return later;
}

/// Duration of each motion at the mean speed of the path within 1 s before and after (the slope of a line fitted to its
/// length over the recorded times). Slow motions take the recorded time.
std::vector<double> evenDurations(const ScanSeries& recorded, const std::vector<Motion>& motions) {
  constexpr double kWithin_s = 1, kSlow_mps = 0.1;
  const auto& scans = recorded.scans;
  std::vector<double> driven_m{0};
  for (std::size_t k = 1; k < scans.size(); ++k) driven_m.push_back(driven_m.back() + motions[k].length_m);
  std::vector<double> durations_s{0};
  for (std::size_t k = 1; k < scans.size(); ++k) {
    double n = 0, t = 0, s = 0, tt = 0, ts = 0;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      const double after_s = scans[i].time_s - scans[k].time_s, farther_m = driven_m[i] - driven_m[k];
      if (std::abs(after_s) > kWithin_s) continue;
      n += 1;
      t += after_s;
      s += farther_m;
      tt += after_s * after_s;
      ts += after_s * farther_m;
    }
    const double speed_mps = (n * ts - t * s) / (n * tt - t * t);
    const double recorded_s = scans[k].time_s - scans[k - 1].time_s;
    const double even_s = motions[k].length_m / speed_mps;
    durations_s.push_back(std::abs(speed_mps) > kSlow_mps && even_s > 0 ? even_s : recorded_s);
  }
  return durations_s;
}

/// Reads an element of the <sensors> of a robot type.
template <typename Read>
auto readOf(const std::string& robot_type, const std::string& kind, const Read& read) {
  ErrorList errors;
  const XmlElement type = readXmlFile(robot_type);
  std::optional<decltype(read(std::declval<XmlReader&>()))> found;
  for (const auto& child : type.children) {
    if (child.name != "sensors") continue;
    for (const auto& element : child.children) {
      if (element.name != kind) continue;
      XmlReader reader(element, robot_type, errors);
      found = read(reader);
    }
  }
  errors.throwIfAny();
  if (!found) throw ConfigError(robot_type + ": has no <" + kind + ">; add one");
  return *std::move(found);
}

}  // namespace

LaserOptions laserOf(const std::string& robot_type) {
  return readOf(robot_type, "laser", [](XmlReader& reader) { return LaserOptions::read(reader); });
}

ScanSeries simulateDrive(const ScanSeries& recorded, const std::vector<TPose2D>& path,
                         const SimulatedSurroundings& around, const std::string& robot_type, std::uint64_t seed) {
  const LaserOptions options = laserOf(robot_type);
  const auto laser = makeLaser(options);
  const auto odometry = readOf(robot_type, "odometry", [](XmlReader& reader) {
    return readSensor(reader, {1, 0.3, 1});
  });
  const SensorInfo& info = laser->info();
  ScanSeries drive;
  drive.label = info.label;
  drive.first_rad = info.beams.front().robot_from_beam.yaw;
  drive.step_rad =
      (info.beams.back().robot_from_beam.yaw - drive.first_rad) / static_cast<double>(info.beams.size() - 1);
  drive.range_max_m = info.range_max_m;
  drive.robot_from_scanner = {info.beams.front().robot_from_beam.x, info.beams.front().robot_from_beam.y, 0};

  constexpr double kArea_m = 60;
  Scene scene(around.solids, 1, {-kArea_m, kArea_m, -kArea_m, kArea_m});
  std::vector<Readings> readings(1);
  readings[0].measurements = {laser->blank(), odometry->blank()};
  const std::vector<double> durations_s = evenDurations(recorded, motionsOf(path));
  // A scan that is as old as the mean is that of the path.
  const std::vector<TPose2D> driven = laterPoses(path, durations_s, options.timing.latency_s);
  const std::vector<Motion> motions = motionsOf(driven);
  SimTime time;
  double time_s = recorded.scans[0].time_s;
  for (std::size_t k = 0; k < recorded.scans.size(); ++k) {
    const Motion& motion = motions[k];
    if (k > 0) time = {k, durations_s[k]};
    time_s += durations_s[k];
    const TPose2D& pose = driven[k];
    scene.place(0, {Circle{{pose.x, pose.y}, 0.1}, {0, 0.1}});
    scene.freeze();
    const PlanarTransform frame(pose, 0);
    const float pan_rad = 0;
    const std::uint32_t robot = 0;
    const Snapshot now{.scene = scene,
                       .heat_sources = {},
                       .world_from_robot = {&pose, 1},
                       .frames = {&frame, 1},
                       .last_motion = {&motion, 1},
                       .laser_pan_rad = {&pan_rad, 1},
                       .time = time,
                       .seed = seed,
                       .reflectivity = around.reflectivity};
    laser->sense(now, {&robot, 1}, 0, readings);
    odometry->sense(now, {&robot, 1}, 1, readings);
    RecordedScan scan{.time_s = time_s, .ranges_m = {}, .odometry = {}};
    for (const auto& echo : std::get<Echoes>(readings[0].measurements[0])) {
      const bool is_valid = echo.range_m < static_cast<float>(info.no_echo_m);
      scan.ranges_m.push_back(is_valid ? static_cast<double>(echo.range_m) : std::numeric_limits<double>::quiet_NaN());
    }
    scan.odometry = std::get<Odometry>(readings[0].measurements[1]).odom_from_robot;
    drive.scans.push_back(std::move(scan));
  }
  return drive;
}

}  // namespace robosim
