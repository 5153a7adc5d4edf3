#include "calibration/beam_model.h"

#include <algorithm>
#include <cmath>

#include "base/interrupt.h"

namespace robosim {
namespace {

/// Largest change of any parameter.
double computeChange(const BeamModel& a, const BeamModel& b) {
  return std::max({std::abs(a.z_hit - b.z_hit), std::abs(a.z_short - b.z_short), std::abs(a.z_max - b.z_max),
                   std::abs(a.z_rand - b.z_rand), std::abs(a.sigma_hit_m - b.sigma_hit_m),
                   std::abs(a.lambda_short_per_m - b.lambda_short_per_m)});
}

}  // namespace

BeamModel fitBeamModel(const std::vector<ExpectedReading>& readings, double range_max_m) {
  constexpr int kIterations = 200;
  constexpr double kConverged = 1e-6;
  constexpr double kSmallestSigma_m = 1e-4;
  BeamModel model;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    throwIfInterrupted("nothing was written");
    double hit = 0, brief = 0, max = 0, random = 0, squares_m2 = 0, short_sum_m = 0;
    for (const auto& reading : readings) {
      if (std::isnan(reading.read_m)) {
        max += 1;
        continue;
      }
      const double z = reading.read_m, error_m = z - reading.expected_m;
      const double scaled = error_m / model.sigma_hit_m;
      const double p_hit = model.z_hit * std::exp(-scaled * scaled / 2) / (model.sigma_hit_m * std::sqrt(2 * M_PI));
      const double lambda = model.lambda_short_per_m;
      const double p_short = z < reading.expected_m ? model.z_short * lambda * std::exp(-lambda * z) /
                                                          (1 - std::exp(-lambda * reading.expected_m))
                                                    : 0;
      const double p_random = model.z_rand / range_max_m;
      const double sum = p_hit + p_short + p_random;
      if (!(sum > 0)) {
        random += 1;
        continue;
      }
      hit += p_hit / sum;
      brief += p_short / sum;
      random += p_random / sum;
      squares_m2 += p_hit / sum * error_m * error_m;
      short_sum_m += p_short / sum * z;
    }
    const auto n = static_cast<double>(readings.size());
    BeamModel next = model;
    next.z_hit = hit / n;
    next.z_short = brief / n;
    next.z_max = max / n;
    next.z_rand = random / n;
    if (hit > 0) next.sigma_hit_m = std::max(kSmallestSigma_m, std::sqrt(squares_m2 / hit));
    if (short_sum_m > 0) next.lambda_short_per_m = brief / short_sum_m;
    const bool has_converged = computeChange(model, next) < kConverged;
    model = next;
    if (has_converged) break;
  }
  return model;
}

}  // namespace robosim
