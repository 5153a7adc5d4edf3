#include "sensors/laser_errors.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "base/portable_math.h"

namespace robosim {
namespace {

constexpr double kLostEcho = std::numeric_limits<double>::infinity();

std::vector<LaserErrors::StdAt> readStdTable(XmlReader& noise, const std::vector<LaserErrors::StdAt>& otherwise) {
  std::vector<LaserErrors::StdAt> table;
  for (auto& at : noise.all("at")) {
    const double range_m = at.number("range_m", Bounds::notNegative(1000));
    table.push_back({range_m, at.number("std_m", Bounds::notNegative(1))});
    if (table.size() > 1 && range_m <= table[table.size() - 2].range_m) {
      at.errorAt("range_m", "must be above that of the <at> before it; sort them by range");
    }
    at.finish();
  }
  return noise.has("at") ? table : otherwise;
}

/// The logistic number of a uniform one of 32 bits is within ±23.
constexpr double kLogisticMax = 23;

}  // namespace

LaserErrors LaserErrors::read(XmlReader& noise, const LaserErrors& otherwise) {
  LaserErrors e = otherwise;
  e.std_m = noise.number("std_m", Bounds::notNegative(1), otherwise.std_m);
  e.std_per_m = noise.number("std_per_m", Bounds::notNegative(1), otherwise.std_per_m);
  e.std_at = readStdTable(noise, otherwise.std_at);
  const bool has_line = noise.has("std_m") || noise.has("std_per_m");
  if (has_line && noise.has("at")) {
    noise.error("has std_m or std_per_m beside <at>, which replaces both; keep one form");
  } else if (has_line) {
    e.std_at.clear();
  }
  e.tail = noise.number("tail", Bounds::notNegative(1), otherwise.tail);
  e.tail_factor = noise.number("tail_factor", {1, 100}, otherwise.tail_factor);
  e.quantum_m = noise.number("quantum_m", Bounds::notNegative(1), otherwise.quantum_m);
  e.dropout = noise.number("dropout", Bounds::notNegative(1), otherwise.dropout);
  e.outlier = noise.number("outlier", Bounds::notNegative(1), otherwise.outlier);
  if (e.dropout + e.outlier > 1) {
    noise.error("has dropout and outlier with a sum above 1, which excludes any other reading; reduce one of them");
  }
  e.divergence_rad = noise.angle("divergence_deg", Bounds::notNegative(10), otherwise.divergence_rad);
  e.mixing_m = noise.number("mixing_m", Bounds::notNegative(1000), otherwise.mixing_m);
  e.mixing_std = noise.number("mixing_std", Bounds::notNegative(1), otherwise.mixing_std);
  e.reach_m = noise.number("reach_m", Bounds::notNegative(10000), otherwise.reach_m);
  e.fading = noise.number("fading", Bounds::positive(10), otherwise.fading);
  e.drift_m = noise.number("drift_m", {-1, 1}, otherwise.drift_m);
  e.drift_s = noise.number("drift_s", Bounds::positive(1e6), otherwise.drift_s);
  return e;
}

bool LaserErrors::isRandom() const {
  return largestStd(1000) > 0 || dropout > 0 || outlier > 0 || reach_m > 0 || (divergence_rad > 0 && mixing_std > 0);
}

double LaserErrors::stdAt(double range_m) const {
  if (std_at.empty()) return std_m + std_per_m * range_m;
  if (range_m <= std_at.front().range_m) return std_at.front().std_m;
  for (std::size_t i = 1; i < std_at.size(); ++i) {
    const StdAt& far = std_at[i];
    if (range_m > far.range_m) continue;
    const StdAt& near = std_at[i - 1];
    return near.std_m + (far.std_m - near.std_m) * ((range_m - near.range_m) / (far.range_m - near.range_m));
  }
  return std_at.back().std_m;
}

double LaserErrors::readingStdAt(double range_m) const {
  const double gaussian_m = stdAt(range_m);
  const double variance = gaussian_m * gaussian_m * (1 + tail * (tail_factor * tail_factor - 1));
  // Rounding to the quantum adds a uniform error. Without any other error the readings do not vary.
  return gaussian_m == 0 ? 0 : std::sqrt(variance + quantum_m * quantum_m / 12);
}

double LaserErrors::largestStd(double range_max_m) const {
  double largest_m = std::max(readingStdAt(0), readingStdAt(range_max_m));
  for (const auto& at : std_at) {
    if (at.range_m < range_max_m) largest_m = std::max(largest_m, readingStdAt(at.range_m));
  }
  return largest_m;
}

double LaserErrors::driftAt(double time_s) const {
  return drift_m == 0 ? 0 : drift_m * portable::exp(-time_s / drift_s);
}

ErrorProcess::ErrorProcess(const LaserErrors& errors, const SensorInfo& info)
    : errors_(errors),
      range_min_m_(info.range_min_m),
      range_max_m_(info.range_max_m),
      tail_from_(errors.dropout + errors.outlier),
      tail_to_(tail_from_ + errors.tail * (1 - tail_from_)),
      per_quantum_(errors.quantum_m > 0 ? 1 / errors.quantum_m : 0),
      lost_power_(portable::exp(-errors.fading * kLogisticMax)),
      certain_power_(portable::exp(errors.fading * kLogisticMax)) {
  for (std::size_t n = 0; n < sufficient_power_.size(); ++n) {
    constexpr double kMargin = 1e-9;  // more than rounding errors
    sufficient_power_[n] = portable::exp(errors.fading * M_LN2 * static_cast<double>(n)) * (1 + kMargin);
  }
}

/// Whether log(power) + fading × (a logistic number) is positive.
bool ErrorProcess::isDetected(double power, double uniform) const {
  if (power > certain_power_) return true;
  if (power < lost_power_) return false;
  // For a number u of at least 2^-n, ln((1 - u) / u) is below n ln 2. The exponent of a double gives n without
  // logarithms.
  const auto n = static_cast<std::size_t>(1023 - (std::bit_cast<std::uint64_t>(uniform) >> 52));
  if (n < sufficient_power_.size() && power > sufficient_power_[n]) return true;
  return portable::log(power) + errors_.fading * portable::log(uniform / (1 - uniform)) > 0;
}

double ErrorProcess::readingOf(double range_m, double power, double drift_m, const BeamDraw& draw) const {
  // The event is divided among exclusive ones.
  if (draw.event < tail_from_) {
    return draw.event < errors_.dropout ? kLostEcho : range_min_m_ + (range_max_m_ - range_min_m_) * draw.other;
  }
  if (errors_.reach_m > 0 && !isDetected(power, draw.other)) return kLostEcho;
  const double factor = draw.event < tail_to_ ? errors_.tail_factor : 1;
  const double read_m = std::max(0.0, range_m + drift_m + factor * errors_.stdAt(range_m) * draw.gaussian);
  if (per_quantum_ == 0) return read_m;
  return errors_.quantum_m * static_cast<double>(static_cast<std::int64_t>(read_m * per_quantum_ + 0.5));
}

}  // namespace robosim
