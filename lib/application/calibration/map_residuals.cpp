#include "calibration/map_residuals.h"

#include <cmath>
#include <limits>

#include "base/interrupt.h"
#include "base/random.h"

namespace robosim {

std::vector<ExpectedReading> readingsOfScans(const MatchedReadings& matched, std::size_t first, std::size_t stride) {
  std::vector<ExpectedReading> readings;
  for (std::size_t scan = first; scan < matched.first_of_scan.size(); scan += stride) {
    const std::size_t end =
        scan + 1 < matched.first_of_scan.size() ? matched.first_of_scan[scan + 1] : matched.readings.size();
    for (std::size_t i = matched.first_of_scan[scan]; i < end; ++i) readings.push_back(matched.readings[i]);
  }
  return readings;
}

PairStatistics computeResiduals(const std::vector<ExpectedReading>& readings, double jump_m, double range_max_m) {
  std::vector<double> expected_m, read_m;
  for (const auto& reading : readings) {
    expected_m.push_back(reading.expected_m);
    read_m.push_back(reading.read_m);
  }
  PairStatistics residuals{.jump_m = jump_m, .range_max_m = range_max_m};
  residuals.add(expected_m, read_m, expected_m);
  return residuals;
}

PairStatistics simulateResiduals(const std::vector<ExpectedReading>& readings, const LaserErrors& errors, double jump_m,
                                 double range_max_m, std::size_t count, std::uint64_t seed) {
  SensorInfo info{.kind = SensorKind::laser, .label = "", .beams = {}};
  info.range_max_m = range_max_m;
  const ErrorProcess process(errors, info);
  constexpr double kPower = std::numeric_limits<double>::infinity();
  Rng rng(seed);
  PairStatistics all{.jump_m = jump_m, .range_max_m = range_max_m};
  std::vector<ExpectedReading> simulated = readings;
  for (std::size_t repetition = 0; repetition < count; ++repetition) {
    throwIfInterrupted("nothing was written");
    for (auto& reading : simulated) {
      const BeamDraw draw{.event = rng.uniform(), .other = rng.uniform(), .gaussian = rng.gaussian()};
      const double read_m = process.readingOf(reading.expected_m, kPower, 0, draw);
      reading.read_m = read_m < range_max_m ? read_m : std::numeric_limits<double>::quiet_NaN();
    }
    all.add(computeResiduals(simulated, jump_m, range_max_m));
  }
  return all;
}

}  // namespace robosim
