#include "calibration/binned_sample.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace robosim {
namespace {

constexpr double kRobustStd = 1.4826;  // median of the absolute values of a Gaussian, inverted
constexpr double kSmallestBin_m = 1e-5;

double gaussianBelow(double x) { return 0.5 * std::erfc(-x * M_SQRT1_2); }

/// Integral of gaussianBelow(), for standard deviation `std`.
double computeRamp(double x, double std) {
  return x * gaussianBelow(x / std) + std * std::exp(-x * x / (2 * std * std)) / std::sqrt(2 * M_PI);
}

}  // namespace

BinnedSample::BinnedSample(Sample kind, const std::vector<double>& values_m, double quantum_m, double window_m)
    : kind_(kind), quantum_m_(quantum_m), window_m_(window_m), size_(values_m.size()) {
  std::vector<double> sizes_m;
  for (const double value_m : values_m) sizes_m.push_back(std::abs(value_m));
  const auto middle = sizes_m.begin() + static_cast<std::ptrdiff_t>(sizes_m.size() / 2);
  if (!sizes_m.empty()) {
    std::nth_element(sizes_m.begin(), middle, sizes_m.end());
    median_m_ = *middle;
  }
  const double wanted_m = std::max(kSmallestBin_m, median_m_ / 3);  // 0.22 standard deviations
  width_m_ = quantum_m_ > 0 ? (2 * std::floor(wanted_m / quantum_m_ / 2) + 1) * quantum_m_ : wanted_m;
  std::map<long, double> histogram;
  for (const double value_m : values_m) histogram[std::lround(value_m / width_m_)] += 1;
  for (const auto& [bin, count] : histogram) {
    bins_.push_back(bin);
    counts_.push_back(count);
  }
  for (const double value_m : values_m) {
    const auto at = std::lower_bound(bins_.begin(), bins_.end(), std::lround(value_m / width_m_));
    bin_of_.push_back(static_cast<std::size_t>(at - bins_.begin()));
  }
}

double BinnedSample::roughStd() const {
  const double std_m = kRobustStd * median_m_ * (kind_ == Sample::differences ? M_SQRT1_2 : 1);
  return std::max(std_m, width_m_ / 4);
}

/// Probability that the difference of two rounded readings, or a residual of a rounded one, lies below `at_m`, which is
/// between two multiples of the quantum: the Gaussian convolved with a uniform distribution of the quantum's width.
double BinnedSample::cumulative(double at_m, double std_m) const {
  if (quantum_m_ == 0) return gaussianBelow(at_m / std_m);
  const double half_m = quantum_m_ / 2;
  return (computeRamp(at_m + half_m, std_m) - computeRamp(at_m - half_m, std_m)) / quantum_m_;
}

double BinnedSample::cumulative(double at_m, const NoiseShape& shape) const {
  const double s = shape.std_m, t = shape.tail, k = shape.tail_factor;
  if (kind_ == Sample::residuals) {
    return t == 0 ? cumulative(at_m, s) : (1 - t) * cumulative(at_m, s) + t * cumulative(at_m, k * s);
  }
  const double both = cumulative(at_m, M_SQRT2 * s);
  if (t == 0) return both;
  return (1 - t) * (1 - t) * both + 2 * t * (1 - t) * cumulative(at_m, s * std::sqrt(1 + k * k)) +
         t * t * cumulative(at_m, M_SQRT2 * k * s);
}

double BinnedSample::beyondWindow(const NoiseShape& shape) const {
  return std::max(0.0, 2 * cumulative(-window_m_, shape));
}

std::vector<double> BinnedSample::logProbabilities(const NoiseShape& shape, double outliers) const {
  const double inside = 1 - beyondWindow(shape);
  std::vector<double> logs;
  double edge_m = 0, below = 0;  // the last upper edge
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    const double middle_m = width_m_ * static_cast<double>(bins_[i]);
    const double low_m = std::max(middle_m - width_m_ / 2, -window_m_);
    const double high_m = std::min(middle_m + width_m_ / 2, window_m_);
    const double at_low = i > 0 && bins_[i - 1] + 1 == bins_[i] && edge_m == low_m ? below : cumulative(low_m, shape);
    edge_m = high_m;
    below = cumulative(high_m, shape);
    const double noise = std::max(0.0, below - at_low) / inside;
    const double uniform = (high_m - low_m) / (2 * window_m_);
    logs.push_back(std::log(std::max((1 - outliers) * noise + outliers * uniform, 1e-30)));
  }
  return logs;
}

double BinnedSample::logLikelihood(const NoiseShape& shape, double outliers) const {
  const auto logs = logProbabilities(shape, outliers);
  double sum = 0;
  for (std::size_t i = 0; i < logs.size(); ++i) sum += counts_[i] * logs[i];
  return sum;
}

std::vector<double> BinnedSample::scores(const NoiseShape& shape, double outliers) const {
  constexpr double kStep = 0.01;
  NoiseShape narrow = shape, wide = shape;
  narrow.std_m *= std::exp(-kStep);
  wide.std_m *= std::exp(kStep);
  const auto low = logProbabilities(narrow, outliers), high = logProbabilities(wide, outliers);
  std::vector<double> scores;
  for (const std::size_t bin : bin_of_) scores.push_back((high[bin] - low[bin]) / (2 * kStep));
  return scores;
}

}  // namespace robosim
