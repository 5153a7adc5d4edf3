#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

namespace robosim {

/// A scan of a recording.
struct RecordedScan {
  double time_s = 0;                            ///< since the recording's first observation
  std::vector<double> ranges_m;                 ///< by beam, anticlockwise from above; NaN for an invalid reading
  std::optional<mrpt::math::TPose2D> odometry;  ///< the last one before the scan
};

/// All scans of one scanner of a recording, in order.
struct ScanSeries {
  std::string label;       ///< as recorded; with "#1", "#2" … if several scanners have it
  double step_rad = 0;     ///< between adjacent beams, > 0
  double first_rad = 0;    ///< direction of the first beam, in the scanner's frame
  double range_max_m = 0;  ///< as recorded
  std::vector<RecordedScan> scans;
  mrpt::math::TPose2D robot_from_scanner = {};  ///< mounting pose
};

/// Reads the scans of a scanner (CObservation2DRangeScan) from a rawlog in either of MRPT's formats. Scans of one label
/// from different poses on the robot (by more than 1 mm or 1 mrad) are those of different scanners. Ranges of clockwise
/// and of inverted scanners are reversed.
/// @param sensor label, or its part after "/"; empty: the only scanner
/// @param progress called with the number of entries so far; may throw to end the reading
/// @throws ConfigError for a file that is no rawlog, without scans of that sensor, or with several scanners if `sensor`
/// is empty
ScanSeries readScans(const std::string& rawlog, const std::string& sensor,
                     const std::function<void(std::uint64_t)>& progress = {});

/// Two successive scans between which the odometry did not change.
struct ScanPair {
  std::size_t first = 0;  ///< index of the first scan; the second follows it
  double turned_rad = 0;  ///< rotation between the scans, estimated from them
  double turned_t = 0;    ///< the same, in standard errors
  bool is_at_rest = true;
};

/// Finds the pairs at unchanged odometry (0.1 mm, 0.1 mrad), at most 2 s apart; all such pairs of a recording without
/// odometry. A pair is not at rest if its scans contradict the odometry: the rotation that explains the differences of
/// their ranges best (by the slope of the range over the angle, least squares) exceeds five standard errors.
std::vector<ScanPair> standingPairs(const ScanSeries& series);

/// Divides pairs, which are in order, into those of one stay at one place: with the same odometry, or without odometry
/// successive ones.
std::vector<std::vector<ScanPair>> standingGroups(const ScanSeries& series, const std::vector<ScanPair>& pairs);

/// The scans of pairs, in order.
std::vector<std::size_t> listScans(const std::vector<ScanPair>& pairs);

/// Median of the valid readings of each beam in the scans of pairs of one place; NaN without any.
std::vector<double> medianRanges(const ScanSeries& series, const std::vector<ScanPair>& pairs);

}  // namespace robosim
