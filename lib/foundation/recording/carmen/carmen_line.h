#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <mrpt/math/TPose2D.h>

namespace robosim {

/// A scan in a log of CARMEN.
struct CarmenScan {
  unsigned scanner = 1;         ///< 1: front, 2: rear, up to 5
  std::vector<float> ranges_m;  ///< from the right to the left
  double first_rad = 0;         ///< direction of the first beam in the scanner's frame
  double between_rad = 0;       ///< between two beams
  double max_m = 0;             ///< ranges from here on are no echo
  bool is_guessed = false;      ///< of an old line, FLASER or RLASER, which says neither angles nor maximum
  /// Of the scanner, in the frame of the odometry; in old lines that SLAM has corrected, in that of a map.
  std::optional<mrpt::math::TPose2D> odom_from_scanner;
};

/// A line of a log of CARMEN.
struct CarmenLine {
  std::string type;              ///< "FLASER"
  std::optional<double> time_s;  ///< of the measurement, since 1970; nullopt for none
  std::optional<CarmenScan> scan;
  std::optional<mrpt::math::TPose2D> odom_from_robot;        ///< of ODOM and of scans with poses
  std::optional<std::array<double, 2>> speeds;               ///< of ODOM: forwards [m/s], turning left [rad/s]
  std::optional<mrpt::math::TPose2D> world_from_robot;       ///< of TRUEPOS
  std::optional<std::pair<std::string, std::string>> param;  ///< name and value
  bool is_unread = false;                                    ///< a message of another type
};

/// Parses a line: FLASER, RLASER, ROBOTLASER1 and 2 (also in the form without remissions), RAWLASER1 to 5, ODOM,
/// TRUEPOS, PARAM and SYNC. The times at the end may be missing. Format:
/// http://carmen.sourceforge.net/logger_playback.html; the angles of old lines follow from the number of readings as in
/// CARMEN's readlog.c, except that 400 and 401 readings are 100° about the front, as SICK's scanners have them.
/// @param line without its end, neither empty nor a comment
/// @throws std::runtime_error "FLASER: announces 180 readings, but 3 numbers follow"
CarmenLine parseCarmenLine(std::string_view line);

}  // namespace robosim
