#pragma once
#include <cstdint>
#include <vector>

#include "calibration/matched_scans.h"
#include "calibration/pair_statistics.h"
#include "sensors/laser_errors.h"

namespace robosim {

/// The readings of every `stride`-th aligned scan, from scan `first` on.
std::vector<ExpectedReading> readingsOfScans(const MatchedReadings& matched, std::size_t first, std::size_t stride);

/// Residuals of readings about their expected ranges, as a PairStatistics whose first scan is the expected one: a
/// difference is a residual, a jump a residual above jump_m, and a change of validity a lost echo.
PairStatistics computeResiduals(const std::vector<ExpectedReading>& readings, double jump_m = kJump_m,
                                double range_max_m = 0);

/// Residuals of simulated readings: each expected range is measured `count` times with these errors, by the error
/// process of RoboSim's scanner.
/// @param range_max_m of the scanner
/// @throws Interrupted when a signal requests the end
PairStatistics simulateResiduals(const std::vector<ExpectedReading>& readings, const LaserErrors& errors, double jump_m,
                                 double range_max_m, std::size_t count, std::uint64_t seed);

}  // namespace robosim
