#pragma once
#include <vector>

#include "calibration/beam_model.h"
#include "calibration/standing_scans.h"

namespace robosim {

/// Readings of the scans of a drive with the ranges that a local map predicts: the surfaces of the kMapScans scans
/// before, aligned by scan matching.
struct MatchedReadings {
  std::vector<ExpectedReading> readings;
  std::vector<std::size_t> first_of_scan;  ///< index of the first of `readings` of each scan that was aligned
  std::size_t matched = 0;                 ///< scans that were aligned
  std::size_t failed = 0;  ///< scans of which too few points lie near the map; a new map begins with them
};

constexpr std::size_t kMapScans = 3;

/// Which of the surfaces of the map's scans a beam is expected to meet.
enum class MapRange {
  nearest,  ///< the nearest one: below the true range, because the surfaces have errors
  mean,     ///< the mean of the surfaces within kSameSurface_m beyond the nearest one: without that bias
};

constexpr double kSameSurface_m = 0.15;

/// Aligns each scan with the map of those before it (iterative closest point with point-to-line distances: Censi, "An
/// ICP variant using a point-to-line metric", ICRA 2008), from the pose that the odometry predicts. Adjacent points of
/// a scan are a surface if they are near each other compared with the distance of adjacent beams on it. Readings of
/// beams that meet no surface of the map are left out.
/// @throws Interrupted when a signal requests the end
MatchedReadings matchScans(const ScanSeries& series, MapRange range = MapRange::nearest);

}  // namespace robosim
