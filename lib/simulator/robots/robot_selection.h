#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "robots/fleet.h"

namespace robosim {

/// A choice of robots by their names, as of `--only`. A pattern is one of:
/// - a name: `Robot3`
/// - a name with `*` for any characters and `?` for one character: `Robot*`
/// - a range of numbers after the same letters: `Robot3..Robot12` or `Robot3..12`
/// A robot whose name is the whole pattern is chosen before the pattern is read in another way.
class RobotSelection {
 public:
  /// What becomes of a pattern without a robot: an error, or nothing, as when a run continues with another world.
  enum class Unmatched { refused, ignored };

  /// All robots.
  RobotSelection() = default;
  /// @param patterns none: all robots
  explicit RobotSelection(std::vector<std::string> patterns) : patterns_(std::move(patterns)) {}

  bool isAll() const { return patterns_.empty(); }
  /// Flags of the chosen robots, in the order of the fleet; empty for all.
  /// @throws ConfigError naming a pattern without a robot, and the nearest name or the robots that there are
  std::vector<std::uint8_t> flagsIn(const Fleet& fleet, Unmatched unmatched) const;

 private:
  std::vector<std::string> patterns_;
};

/// "there is no robot NAME", with the nearest name or the names that there are.
std::string describeUnknownRobot(const std::string& name, const Fleet& fleet);

}  // namespace robosim
