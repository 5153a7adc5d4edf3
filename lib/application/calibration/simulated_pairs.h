#pragma once
#include <cstdint>
#include <vector>

#include "calibration/lost_echoes.h"
#include "calibration/pair_statistics.h"
#include "sensors/laser_errors.h"

namespace robosim {

/// What a beam of a scanner at rest sees, estimated from its readings.
struct SeenSurface {
  double range_m = 0;  ///< mean of the valid readings within the limit of jumps of their median; 0 without any
  double valid = 0;    ///< share of valid readings
  double flips = 0;    ///< share of the pairs in which the validity changes
};

/// The surfaces seen in the scans of pairs, which all belong to one pose of the robot.
/// @param echoes countLostEchoes(): steady beams count as valid in all scans
/// @param jump_m computeJumpLimit()
std::vector<SeenSurface> seenSurfaces(const ScanSeries& series, const std::vector<ScanPair>& pairs,
                                      const LostEchoes& echoes, double jump_m);

/// Pairs of successive scans of RoboSim's scanner with these errors, at rest in an equivalent scene: for each beam a
/// wall that faces it at SeenSurface::range_m, with a reflectivity at which the validity changes, together with
/// LaserErrors::dropout, as often as SeenSurface::flips. Beams without valid readings see nothing. The walls are
/// narrower than the distance of the beams, so that no beam sees a wall of another.
/// @param errors with reach_m 0 if no beam flickers
/// @param count number of simulated pairs for each given pair
/// @throws Interrupted when a signal requests the end
PairStatistics simulatePairs(const ScanSeries& series, const std::vector<ScanPair>& pairs, const LaserErrors& errors,
                             const LostEchoes& echoes, double jump_m, std::size_t count, std::uint64_t seed);

}  // namespace robosim
