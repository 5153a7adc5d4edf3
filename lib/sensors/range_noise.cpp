#include "sensors/range_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace robosim {

RangeNoise RangeNoise::read(XmlReader& noise, const RangeNoise& data_sheet) {
  return {.on = true,
          .std_m = noise.number("std_m", Bounds::notNegative(1), data_sheet.std_m),
          .std_per_m = noise.number("std_per_m", Bounds::notNegative(1), data_sheet.std_per_m),
          .dropout = noise.number("dropout", Bounds::notNegative(1), data_sheet.dropout)};
}

double RangeNoise::apply(double range_m, Rng& rng) const {
  if (rng.uniform() < dropout) return std::numeric_limits<double>::infinity();
  const double error_m = stdAt(range_m) * rng.gaussian();
  return std::isfinite(range_m) ? std::max(0.0, range_m + error_m) : range_m;
}

}  // namespace robosim
