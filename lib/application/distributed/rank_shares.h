#pragma once
#include <cstddef>
#include <vector>

#include "environment/robot_range.h"

namespace robosim {

/// Division of the robots of a world among ranks, as contiguous ranges in the world's order, by rank.
struct RankShares {
  std::vector<RobotRange> home;      ///< whose controllers the rank runs; constant, but for added robots
  std::vector<RobotRange> digested;  ///< that the rank adds to the run's digest: whole chunks; as home
  std::vector<RobotRange> work;      ///< whose moves and sensors the rank computes; changed by balancedWork()
  std::size_t robots = 0;
  bool first_needs_all = false;  ///< whether rank 0 needs the readings of all robots, to record them

  /// Equal shares: home and work are the same, and whole chunks of the digest when there are at least as many chunks as
  /// ranks. Ranks without a robot have empty ranges.
  static RankShares of(std::size_t robots, int ranks, bool first_needs_all);
  std::size_t ranks() const { return home.size(); }
  /// Adds robots at the end of the world's order: those of the last rank, and of the last part of the digest.
  void addRobots(std::size_t robots_now);
  /// The robots whose readings a rank needs after each step.
  RobotRange needed(std::size_t rank) const;
  /// The robots whose readings a rank keeps: those, and those that it computes.
  RobotRange kept(std::size_t rank) const;
};

/// The robots in both ranges; may be empty().
RobotRange intersection(RobotRange a, RobotRange b);
/// The smallest range that contains both; the other one, if one is empty.
RobotRange hull(RobotRange a, RobotRange b);

/// Time in which a rank has computed, not counting the time in which it has waited for others.
struct BusyTime {
  double work_s = 0;   ///< for moves and sensors of its RankShares::work
  double other_s = 0;  ///< for all else
};

/// RankShares::work for which all ranks would be busy equally long, if each robot took as long as the average one of
/// its present rank; half way from the present ranges to these, so that measurement errors matter less. The present
/// ranges when no rank is busy more than 5 % longer than the average, or when no time was measured.
/// @param busy by rank
std::vector<RobotRange> balancedWork(const std::vector<RobotRange>& work, const std::vector<BusyTime>& busy);

}  // namespace robosim
