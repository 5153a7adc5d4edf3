#include "calibration/matched_scans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>

#include <mrpt/math/TPoint2D.h>

#include "base/interrupt.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr int kIterations = 30;
constexpr double kFarthest_m = 0.5;  ///< of a point from its surface, in the first iteration
constexpr double kNearest_m = 0.05;  ///< … in the last ones
constexpr std::size_t kFewestPoints = 30;

struct Segment {
  TPoint2D from, to;
};

/// Points of a scan in its own frame, and which of them are joined to the next one.
struct Surface {
  TPose2D map_from_scan;
  std::vector<Segment> segments;  ///< in the map's frame
};

TPoint2D toPoint(const ScanSeries& series, std::size_t beam, double range_m) {
  const double bearing_rad = series.first_rad + series.step_rad * static_cast<double>(beam);
  return {range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad)};
}

Surface toSurface(const ScanSeries& series, const std::vector<double>& ranges_m, const TPose2D& map_from_scan) {
  Surface surface{map_from_scan, {}};
  for (std::size_t i = 0; i + 1 < ranges_m.size(); ++i) {
    if (std::isnan(ranges_m[i]) || std::isnan(ranges_m[i + 1])) continue;
    const double smaller_m = std::min(ranges_m[i], ranges_m[i + 1]);
    // A surface at up to 80° of incidence.
    if (std::abs(ranges_m[i] - ranges_m[i + 1]) > 6 * smaller_m * series.step_rad + 0.03) continue;
    surface.segments.push_back({map_from_scan.composePoint(toPoint(series, i, ranges_m[i])),
                                map_from_scan.composePoint(toPoint(series, i + 1, ranges_m[i + 1]))});
  }
  return surface;
}

/// The point of a segment nearest to `p`.
TPoint2D nearestOn(const Segment& s, const TPoint2D& p) {
  const TPoint2D along = s.to - s.from;
  const double squared = along.x * along.x + along.y * along.y;
  if (squared == 0) return s.from;
  const TPoint2D out = p - s.from;
  return s.from + along * std::clamp((out.x * along.x + out.y * along.y) / squared, 0.0, 1.0);
}

/// Normal equations of a small motion (x, y, phi) about the map's origin, and its solution.
class Motion3 {
 public:
  void add(const TPoint2D& at, const TPoint2D& normal, double error_m) {
    const double row[3] = {normal.x, normal.y, at.x * normal.y - at.y * normal.x};
    for (int i = 0; i < 3; ++i) {
      right_[i] -= row[i] * error_m;
      for (int k = 0; k < 3; ++k) left_[i][k] += row[i] * row[k];
    }
  }
  /// Gaussian elimination with a small ridge, so that a corridor's free direction stays where the odometry predicts.
  TPose2D solve() const {
    double a[3][4];
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) a[i][k] = left_[i][k] + (i == k ? 1e-3 : 0);
      a[i][3] = right_[i];
    }
    for (int i = 0; i < 3; ++i) {
      for (int row = 0; row < 3; ++row) {
        if (row == i) continue;
        const double factor = a[row][i] / a[i][i];
        for (int k = i; k < 4; ++k) a[row][k] -= factor * a[i][k];
      }
    }
    return {a[0][3] / a[0][0], a[1][3] / a[1][1], a[2][3] / a[2][2]};
  }

 private:
  double left_[3][3]{}, right_[3]{};
};

/// @return the number of points within kNearest_m of the map in the last iteration
std::size_t align(const ScanSeries& series, const std::vector<double>& ranges_m, const std::deque<Surface>& map,
                  TPose2D& map_from_scan) {
  std::size_t near = 0;
  double farthest_m = kFarthest_m;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Motion3 motion;
    near = 0;
    const TPoint2D center(map_from_scan.x, map_from_scan.y);
    for (std::size_t i = 0; i < ranges_m.size(); ++i) {
      if (std::isnan(ranges_m[i])) continue;
      const TPoint2D p = map_from_scan.composePoint(toPoint(series, i, ranges_m[i]));
      double best_m = farthest_m;
      const Segment* best = nullptr;
      for (const auto& surface : map) {
        for (const auto& segment : surface.segments) {
          // Cheaper than the distance, which it never exceeds.
          if (std::min(segment.from.x, segment.to.x) > p.x + best_m ||
              p.x - best_m > std::max(segment.from.x, segment.to.x) ||
              std::min(segment.from.y, segment.to.y) > p.y + best_m ||
              p.y - best_m > std::max(segment.from.y, segment.to.y)) {
            continue;
          }
          const double distance_m = (nearestOn(segment, p) - p).norm();
          if (distance_m >= best_m) continue;
          best_m = distance_m;
          best = &segment;
        }
      }
      if (!best) continue;
      const TPoint2D along = best->to - best->from;
      const double length_m = along.norm();
      if (length_m == 0) continue;
      const TPoint2D normal(-along.y / length_m, along.x / length_m);
      const TPoint2D off = p - best->from;
      near += best_m < kNearest_m;
      motion.add(p - center, normal, off.x * normal.x + off.y * normal.y);
    }
    const TPose2D by = motion.solve();
    map_from_scan.x += by.x;
    map_from_scan.y += by.y;
    map_from_scan.phi += by.phi;
    farthest_m = std::max(kNearest_m, farthest_m * 0.8);
  }
  return near;
}

/// Range at which a ray meets a surface; infinite for none.
double castInto(const Surface& surface, const TPoint2D& from, const TPoint2D& direction) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const auto& segment : surface.segments) {
    const TPoint2D along = segment.to - segment.from, out = segment.from - from;
    const double across = direction.x * along.y - direction.y * along.x;
    if (across == 0) continue;
    const double at_m = (out.x * along.y - out.y * along.x) / across;
    const double share = (out.x * direction.y - out.y * direction.x) / across;
    if (at_m > 0 && share >= 0 && share <= 1) nearest_m = std::min(nearest_m, at_m);
  }
  return nearest_m;
}

/// Range at which a ray meets the map; infinite for none.
double castInto(const std::deque<Surface>& map, const TPoint2D& from, const TPoint2D& direction, MapRange range) {
  std::array<double, kMapScans> each_m;
  each_m.fill(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < map.size(); ++i) each_m[i] = castInto(map[i], from, direction);
  const double nearest_m = *std::min_element(each_m.begin(), each_m.end());
  if (range == MapRange::nearest || std::isinf(nearest_m)) return nearest_m;
  double sum_m = 0;
  int same = 0;
  for (const double at_m : each_m) {
    if (at_m > nearest_m + kSameSurface_m) continue;
    sum_m += at_m;
    ++same;
  }
  return sum_m / same;
}

}  // namespace

MatchedReadings matchScans(const ScanSeries& series, MapRange range) {
  MatchedReadings matched;
  std::deque<Surface> map;
  for (std::size_t k = 0; k < series.scans.size(); ++k) {
    throwIfInterrupted("nothing was written");
    const RecordedScan& scan = series.scans[k];
    TPose2D map_from_scan;
    if (!map.empty()) {
      map_from_scan = map.back().map_from_scan;
      const auto& before = series.scans[k - 1].odometry;
      if (before && scan.odometry) {
        const TPose2D moved = (*scan.odometry + series.robot_from_scanner) - (*before + series.robot_from_scanner);
        map_from_scan = map_from_scan + moved;
      }
      if (align(series, scan.ranges_m, map, map_from_scan) < kFewestPoints) {
        ++matched.failed;
        map.clear();
      } else {
        ++matched.matched;
        matched.first_of_scan.push_back(matched.readings.size());
        for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
          const TPoint2D ahead = map_from_scan.composePoint(toPoint(series, i, 1));
          const TPoint2D from(map_from_scan.x, map_from_scan.y);
          const double expected_m = castInto(map, from, ahead - from, range);
          if (expected_m < series.range_max_m) matched.readings.push_back({scan.ranges_m[i], expected_m});
        }
      }
    }
    map.push_back(toSurface(series, scan.ranges_m, map_from_scan));
    if (map.size() > kMapScans) map.pop_front();
  }
  return matched;
}

}  // namespace robosim
