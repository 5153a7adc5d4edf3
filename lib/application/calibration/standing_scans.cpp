#include "calibration/standing_scans.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>

#include "base/angle_units.h"
#include "base/error_list.h"
#include "base/printable_text.h"
#include "base/text_table.h"
#include "recording/observation_times.h"
#include "recording/rawlog_reader.h"

namespace robosim {
namespace {

constexpr double kInvalid = std::numeric_limits<double>::quiet_NaN();
constexpr double kUnmoved_m = 1e-4, kUnturned_rad = 1e-4;
constexpr double kApart_s = 2;
constexpr double kSamePose_m = 1e-3, kSamePose_rad = 1e-3;
constexpr double kTurnedErrors = 5;

bool isLabel(const std::string& label, const std::string& wanted) {
  return label == wanted || (label.size() > wanted.size() && label.ends_with("/" + wanted));
}

/// Whether the scanner is mounted upside down.
bool isInverted(const mrpt::obs::CObservation2DRangeScan& observation) {
  return observation.sensorPose.getRotationMatrix()(2, 2) < 0;
}

/// The ranges in anticlockwise order as seen from above, whatever the order and the mounting of the scanner are.
RecordedScan toRecordedScan(const mrpt::obs::CObservation2DRangeScan& observation, double time_s) {
  RecordedScan scan{.time_s = time_s, .ranges_m = {}, .odometry = {}};
  for (std::size_t i = 0; i < observation.getScanSize(); ++i) {
    const double range_m = static_cast<double>(observation.getScanRange(i));
    scan.ranges_m.push_back(observation.getScanRangeValidity(i) && std::isfinite(range_m) ? range_m : kInvalid);
  }
  const bool is_anticlockwise = observation.rightToLeft != isInverted(observation);
  if (!is_anticlockwise) std::reverse(scan.ranges_m.begin(), scan.ranges_m.end());
  return scan;
}

/// The mounting pose in the plane: its heading is that of the scanner's x axis, also if the scanner is upside down.
mrpt::math::TPose2D planarPose(const mrpt::poses::CPose3D& pose) {
  const auto rotation = pose.getRotationMatrix();
  return {pose.x(), pose.y(), std::atan2(rotation(1, 0), rotation(0, 0))};
}

/// The scans of one label and one pose on the robot.
struct MountedScanner {
  std::string label;
  mrpt::math::TPose3D pose;
  ScanSeries series;
};

ScanSeries emptySeries(const mrpt::obs::CObservation2DRangeScan& observation) {
  ScanSeries series;
  series.label = observation.sensorLabel;
  const double aperture_rad = static_cast<double>(observation.aperture);
  if (observation.getScanSize() > 1)
    series.step_rad = aperture_rad / static_cast<double>(observation.getScanSize() - 1);
  series.first_rad = -aperture_rad / 2;
  series.robot_from_scanner = planarPose(observation.sensorPose);
  series.range_max_m = static_cast<double>(observation.maxRange);
  return series;
}

bool areSamePose(const mrpt::math::TPose3D& a, const mrpt::math::TPose3D& b) {
  if (std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) > kSamePose_m) return false;
  for (const double turn_rad : {a.yaw - b.yaw, a.pitch - b.pitch, a.roll - b.roll}) {
    if (std::abs(std::remainder(turn_rad, 2 * M_PI)) > kSamePose_rad) return false;
  }
  return true;
}

MountedScanner& findOrAddScanner(const mrpt::obs::CObservation2DRangeScan& observation,
                                 std::vector<MountedScanner>& all) {
  const auto pose = observation.sensorPose.asTPose();
  for (auto& scanner : all) {
    if (scanner.label == observation.sensorLabel && areSamePose(scanner.pose, pose)) return scanner;
  }
  return all.emplace_back(MountedScanner{observation.sensorLabel, pose, emptySeries(observation)});
}

/// Appends "#1", "#2" … to labels that several scanners share.
void numberSharedLabels(std::vector<MountedScanner>& all) {
  std::map<std::string, int> uses, numbers;
  for (const auto& scanner : all) ++uses[scanner.label];
  for (auto& scanner : all) {
    if (uses[scanner.label] > 1) scanner.series.label += "#" + std::to_string(++numbers[scanner.label]);
  }
}

/// "'front', 'rear'": at most ten labels, and the poses of scanners that share one.
std::string namesOf(const std::vector<MountedScanner>& all) {
  std::string names;
  int count = 0;
  for (const auto& scanner : all) {
    if (++count > 10) return names + ", …";
    names += (names.empty() ? "'" : ", '") + quotable(scanner.series.label) + "'";
    if (scanner.series.label == scanner.label) continue;
    const auto& pose = scanner.series.robot_from_scanner;
    names += " at (" + fixed(pose.x, 2) + ", " + fixed(pose.y, 2) + ") m, " + fixed(toDegrees(pose.phi), 0) + "°";
  }
  return names;
}

ScanSeries& chosen(const std::string& rawlog, const std::string& sensor, std::vector<MountedScanner>& all) {
  if (all.empty()) {
    throw ConfigError(rawlog + ": has no laser scans (CObservation2DRangeScan, or LaserScan of ROS 2)" +
                      "; use a recording of a laser scanner");
  }
  if (sensor.empty()) {
    if (all.size() == 1) return all.front().series;
    throw ConfigError(rawlog + ": has scans of several sensors; choose one of them by --sensor: " + namesOf(all));
  }
  ScanSeries* found = nullptr;
  for (auto& scanner : all) {
    if (!isLabel(scanner.series.label, sensor)) continue;
    if (found) {
      throw ConfigError("--sensor " + sensor +
                        ": is a scanner of several robots; give the whole label, one of: " + namesOf(all));
    }
    found = &scanner.series;
  }
  if (!found) {
    throw ConfigError("--sensor " + sensor + ": " + rawlog + " has no such scanner; it has " + namesOf(all) +
                      " (omit --sensor for a scanner without a label)");
  }
  return *found;
}

bool areSamePlace(const RecordedScan& a, const RecordedScan& b) {
  if (!a.odometry || !b.odometry) return true;
  return std::hypot(a.odometry->x - b.odometry->x, a.odometry->y - b.odometry->y) <= kUnmoved_m &&
         std::abs(std::remainder(a.odometry->phi - b.odometry->phi, 2 * M_PI)) <= kUnturned_rad;
}

/// Least squares of difference = slope × shift over the beams at smooth oblique surfaces, with the shift in beams. Its
/// standard error is that of White ("A heteroskedasticity-consistent covariance matrix estimator", Econometrica 48,
/// 1980), because the scatter depends on the surface.
void estimateRotation(const ScanSeries& series, ScanPair& pair) {
  const auto& a = series.scans[pair.first].ranges_m;
  const auto& b = series.scans[pair.first + 1].ranges_m;
  std::vector<std::pair<double, double>> used;  // slopes and differences [m]
  double products = 0, squares = 0;
  for (std::size_t i = 1; i + 1 < a.size(); ++i) {
    const double difference_m = b[i] - a[i];
    const double slope_m = (a[i + 1] - a[i - 1]) / 2;
    const double bend_m = std::abs(a[i + 1] - 2 * a[i] + a[i - 1]);
    const bool is_oblique = std::abs(slope_m) > 0.02 && std::abs(slope_m) < 1;  // false for NaN
    if (!is_oblique || !(bend_m < 0.1 * std::abs(slope_m) + 0.02) || !(std::abs(difference_m) < 0.3)) continue;
    used.emplace_back(slope_m, difference_m);
    products += difference_m * slope_m;
    squares += slope_m * slope_m;
  }
  constexpr std::size_t kFewest = 10;
  if (used.size() < kFewest) return;
  const double shift = products / squares;
  constexpr double kLeastScatter_m = 0.001;
  double scatter = kLeastScatter_m * kLeastScatter_m * squares;
  for (const auto& [slope_m, difference_m] : used) {
    const double residual_m = difference_m - slope_m * shift;
    scatter += slope_m * slope_m * residual_m * residual_m;
  }
  pair.turned_rad = shift * series.step_rad;
  pair.turned_t = shift * squares / std::sqrt(scatter);
  pair.is_at_rest = std::abs(pair.turned_t) <= kTurnedErrors;
}

}  // namespace

ScanSeries readScans(const std::string& rawlog, const std::string& sensor,
                     const std::function<void(std::uint64_t)>& progress) {
  RawlogReader reader(rawlog);
  ObservationTimes times;
  std::vector<MountedScanner> all;
  std::map<std::string, mrpt::math::TPose2D> odometry;  // by robot, the part of the label before "/"
  const auto robotOf = [](const std::string& label) {
    const auto end = label.find('/');
    return end == std::string::npos ? std::string() : label.substr(0, end);
  };
  while (const auto observation = reader.next()) {
    if (progress) progress(reader.entries());
    const double time_s = times.of(*observation, reader.entries());
    if (const auto* odo = dynamic_cast<const mrpt::obs::CObservationOdometry*>(observation.get())) {
      odometry[robotOf(odo->sensorLabel)] = odo->odometry.asTPose();
    } else if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(observation.get())) {
      ScanSeries& series = findOrAddScanner(*scan, all).series;
      RecordedScan read = toRecordedScan(*scan, time_s);
      if (!series.scans.empty() && series.scans.front().ranges_m.size() != read.ranges_m.size()) continue;
      const auto at = odometry.find(robotOf(scan->sensorLabel));
      if (at != odometry.end()) read.odometry = at->second;
      series.scans.push_back(std::move(read));
    }
  }
  numberSharedLabels(all);
  return std::move(chosen(rawlog, sensor, all));
}

std::vector<ScanPair> standingPairs(const ScanSeries& series) {
  std::vector<ScanPair> pairs;
  const bool has_odometry = std::any_of(series.scans.begin(), series.scans.end(),
                                        [](const RecordedScan& scan) { return scan.odometry.has_value(); });
  for (std::size_t i = 0; i + 1 < series.scans.size(); ++i) {
    const RecordedScan& a = series.scans[i];
    const RecordedScan& b = series.scans[i + 1];
    if (b.time_s < a.time_s || b.time_s - a.time_s > kApart_s || !areSamePlace(a, b)) continue;
    // Before the first odometry, the robot stands if the first odometry is the origin; that is not known.
    if (has_odometry && !b.odometry) continue;
    ScanPair pair{.first = i};
    estimateRotation(series, pair);
    pairs.push_back(pair);
  }
  return pairs;
}

std::vector<std::vector<ScanPair>> standingGroups(const ScanSeries& series, const std::vector<ScanPair>& pairs) {
  std::vector<std::vector<ScanPair>> groups;
  for (const auto& pair : pairs) {
    const ScanPair* const last = groups.empty() ? nullptr : &groups.back().back();
    const bool has_odometry = series.scans[pair.first].odometry.has_value();
    constexpr std::size_t kNear = 4;  // scans, of pairs of which every second one is given
    const bool is_same = last && areSamePlace(series.scans[last->first], series.scans[pair.first]) &&
                         (has_odometry || pair.first - last->first <= kNear);
    if (!is_same) groups.emplace_back();
    groups.back().push_back(pair);
  }
  return groups;
}

std::vector<std::size_t> listScans(const std::vector<ScanPair>& pairs) {
  std::vector<std::size_t> scans;
  for (const auto& pair : pairs) {
    for (const std::size_t scan : {pair.first, pair.first + 1}) {
      if (scans.empty() || scan > scans.back()) scans.push_back(scan);
    }
  }
  return scans;
}

std::vector<double> medianRanges(const ScanSeries& series, const std::vector<ScanPair>& pairs) {
  const std::vector<std::size_t> scans = listScans(pairs);
  std::vector<double> median_m(series.scans.empty() ? 0 : series.scans.front().ranges_m.size(), kInvalid);
  std::vector<double> valid_m;
  for (std::size_t i = 0; i < median_m.size(); ++i) {
    valid_m.clear();
    for (const std::size_t scan : scans) {
      const double range_m = series.scans[scan].ranges_m[i];
      if (!std::isnan(range_m)) valid_m.push_back(range_m);
    }
    if (valid_m.empty()) continue;
    const auto middle = valid_m.begin() + static_cast<std::ptrdiff_t>(valid_m.size() / 2);
    std::nth_element(valid_m.begin(), middle, valid_m.end());
    median_m[i] = *middle;
  }
  return median_m;
}

}  // namespace robosim
