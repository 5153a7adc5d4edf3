#include "sensors/range_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace robosim {
namespace {

constexpr int kGaussianDraws = 4;  ///< numbers that Rng::gaussian() draws

}  // namespace

RangeNoise RangeNoise::read(XmlReader& noise, const RangeNoise& data_sheet) {
  return {.on = true,
          .std_m = noise.number("std_m", Bounds::notNegative(1), data_sheet.std_m),
          .std_per_m = noise.number("std_per_m", Bounds::notNegative(1), data_sheet.std_per_m),
          .dropout = noise.number("dropout", Bounds::notNegative(1), data_sheet.dropout)};
}

double RangeNoise::apply(double range_m, Rng& rng) const {
  if (rng.uniform() < dropout) return std::numeric_limits<double>::infinity();
  if (!std::isfinite(range_m)) {
    for (int i = 0; i < kGaussianDraws; ++i) rng();
    return range_m;
  }
  return std::max(0.0, range_m + stdAt(range_m) * rng.gaussian());
}

}  // namespace robosim
