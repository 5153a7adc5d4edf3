#include "calibration/laser_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/error_list.h"
#include "base/interrupt.h"

namespace robosim {
namespace {

/// Counts of the differences of a band, in units of the bin.
using Histogram = std::map<long, double>;

/// Integral of the integral of a Gaussian's distribution function.
double rampOf(double x, double std) {
  return x * 0.5 * std::erfc(-x / (std * M_SQRT2)) + std * std::exp(-x * x / (2 * std * std)) / std::sqrt(2 * M_PI);
}

/// Probability that the difference of two rounded readings is n units, for a Gaussian difference before rounding: the
/// Gaussian convolved with the triangle of width ±1 that the rounding of both causes.
double probabilityOf(long n, double std) {
  const auto x = static_cast<double>(n);
  return std::max(0.0, rampOf(x + 1, std) - 2 * rampOf(x, std) + rampOf(x - 1, std));
}

/// What a histogram counts: differences of two readings, or residuals of one reading about its expected range.
enum class Sample { differences, residuals };

/// Log-likelihood of residuals for readings of standard deviation `std` units. The rounding of a reading and the bins
/// cause the same triangle as the rounding of two readings.
double residualLikelihoodOf(const Histogram& histogram, double std, double tail, double factor) {
  double sum = 0;
  for (const auto& [n, count] : histogram) {
    double p = (1 - tail) * probabilityOf(n, std);
    if (tail > 0) p += tail * probabilityOf(n, std * factor);
    sum += count * std::log(std::max(p, 1e-30));
  }
  return sum;
}

/// Log-likelihood for readings of standard deviation `std` units.
double likelihoodOf(Sample sample, const Histogram& histogram, double std, double tail, double factor) {
  if (sample == Sample::residuals) return residualLikelihoodOf(histogram, std, tail, factor);
  const double single = std * M_SQRT2;
  const double mixed = std * std::sqrt(1 + factor * factor);
  const double wide = single * factor;
  double sum = 0;
  for (const auto& [n, count] : histogram) {
    double p = (1 - tail) * (1 - tail) * probabilityOf(n, single);
    if (tail > 0) p += 2 * tail * (1 - tail) * probabilityOf(n, mixed) + tail * tail * probabilityOf(n, wide);
    sum += count * std::log(std::max(p, 1e-30));
  }
  return sum;
}

/// The standard deviation of the largest likelihood, by golden-section search of its logarithm.
std::pair<double, double> bestStd(Sample sample, const Histogram& histogram, double tail, double factor) {
  constexpr double kGolden = 0.6180339887498949;
  double low = std::log(0.05), high = std::log(100.0);
  const auto at = [&](double log_std) { return likelihoodOf(sample, histogram, std::exp(log_std), tail, factor); };
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = at(a), at_b = at(b);
  for (int i = 0; i < 30; ++i) {
    if (at_a > at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - kGolden * (high - low);
      at_a = at(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + kGolden * (high - low);
      at_b = at(b);
    }
  }
  return {std::exp((low + high) / 2), std::max(at_a, at_b)};
}

double middleOf(std::size_t band) {
  return band + 1 < kBands ? (kBandLimits_m[band] + kBandLimits_m[band + 1]) / 2 : kBandLimits_m[band] * 1.5;
}

LaserFit fitSample(Sample sample, const PairStatistics& statistics, double quantum_m) {
  const double bin_m = quantum_m > 0 ? quantum_m : 0.001;
  std::array<Histogram, kBands> histograms;
  bool has_any = false;
  for (std::size_t band = 0; band < kBands; ++band) {
    const auto& differences_m = statistics.differences_m[band];
    if (differences_m.size() < kFewestDifferences) continue;
    has_any = true;
    for (const double difference_m : differences_m) histograms[band][std::lround(difference_m / bin_m)] += 1;
  }
  if (!has_any) {
    const bool is_at_rest = sample == Sample::differences;
    throw ConfigError(std::string(is_at_rest ? "the scans at rest have" : "half of the scans have") + " fewer than " +
                      std::to_string(kFewestDifferences) + " ranges in every band; use a longer recording" +
                      (is_at_rest ? " of a scanner at rest" : ""));
  }
  LaserFit fit;
  double best = -std::numeric_limits<double>::infinity();
  for (const double tail : {0.0, 0.005, 0.01, 0.02, 0.03, 0.05, 0.075, 0.1, 0.15, 0.2, 0.3}) {
    for (const double factor : {2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0}) {
      throwIfInterrupted("nothing was written");
      double sum = 0;
      std::array<double, kBands> std_m{};
      for (std::size_t band = 0; band < kBands; ++band) {
        if (histograms[band].empty()) continue;
        const auto [std, likelihood] = bestStd(sample, histograms[band], tail, factor);
        std_m[band] = std * bin_m;
        sum += likelihood;
      }
      if (sum <= best) continue;
      best = sum;
      fit.std_m = std_m;
      fit.errors.tail = tail;
      fit.errors.tail_factor = factor;
    }
  }
  if (fit.errors.tail == 0) fit.errors.tail_factor = LaserErrors().tail_factor;
  for (std::size_t band = 0; band < kBands; ++band) {
    if (fit.std_m[band] > 0) fit.errors.std_at.push_back({middleOf(band), fit.std_m[band]});
  }
  fit.errors.quantum_m = quantum_m;
  return fit;
}

}  // namespace

LaserFit fitLaser(const PairStatistics& statistics, double quantum_m) {
  LaserFit fit = fitSample(Sample::differences, statistics, quantum_m);
  fit.errors.outlier = statistics.jumpRate() / 2;
  return fit;
}

LaserFit fitResiduals(const PairStatistics& residuals, double quantum_m) {
  LaserFit fit = fitSample(Sample::residuals, residuals, quantum_m);
  fit.errors.outlier = residuals.jumpRate();
  fit.errors.dropout = residuals.flipRate();
  return fit;
}

}  // namespace robosim
