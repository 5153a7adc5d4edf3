#include "calibration/cross_validation.h"

#include <algorithm>
#include <cmath>

#include "calibration/confidence.h"

namespace robosim {
namespace {

/// Bound of the difference of a rate of the held-out half and that of a model, which is fitted to a half of equal size.
double rateBound(std::size_t hits, std::size_t trials, std::size_t simulated_hits, std::size_t simulated_trials,
                 double level) {
  if (trials == 0 || simulated_trials == 0) return 1;
  const auto n = static_cast<double>(trials), m = static_cast<double>(simulated_trials);
  const double rate = (static_cast<double>(hits) / n + static_cast<double>(simulated_hits) / m) / 2;
  return std::max(kRateTolerance, normalBound(level) * std::sqrt(rate * (1 - rate) * (2 / n + 1 / m)));
}

}  // namespace

double HeldOutFit::computeKsBound(std::size_t band) const {
  return ksBound(real.differences_m[band].size(), simulated.differences_m[band].size());
}

double HeldOutFit::jumpBound(double level) const {
  return rateBound(real.jumps, real.compared, simulated.jumps, simulated.compared, level);
}

double HeldOutFit::flipBound(double level) const {
  return rateBound(real.flips, real.beams, simulated.flips, simulated.beams, level);
}

bool isJumpRateBeyond(const HeldOutFit& half, double level) {
  return std::abs(half.real.jumpRate() - half.simulated.jumpRate()) > half.jumpBound(level);
}

bool isFlipRateBeyond(const HeldOutFit& half, double level) {
  return std::abs(half.real.flipRate() - half.simulated.flipRate()) > half.flipBound(level);
}

}  // namespace robosim
