#pragma once
#include <cstddef>
#include <vector>

#include "calibration/confidence.h"

namespace robosim {

/// What a sample consists of: differences of two readings, or residuals of one reading about its expected range.
enum class Sample { differences, residuals };

/// Distribution of the error of a reading: (1 − tail) N(0, std_m²) + tail N(0, (tail_factor std_m)²).
struct NoiseShape {
  double std_m = 0, tail = 0, tail_factor = 3;
};

/// A sample within ±window_m in bins, and its likelihood as a mixture of noise and of uniform outliers, given that the
/// values lie in the window: values beyond it are neither ignored nor do they bias the noise. With a quantum, readings
/// are rounded after a uniform phase, and a bin is an odd number of quanta wide; without, an eighth of the
/// interquartile range.
class BinnedSample {
 public:
  /// @param window_m between two multiples of the quantum
  BinnedSample(Sample kind, const std::vector<double>& values_m, double quantum_m, double window_m);
  std::size_t size() const { return size_; }
  double binWidth() const { return width_m_; }
  /// Robust estimate of the standard deviation of a reading, at least a quarter of a bin.
  double roughStd() const;

  /// @param outliers share of outliers among the values within the window
  double logLikelihood(const NoiseShape& shape, double outliers) const;
  /// Derivatives of the logarithm of the probability of each value by the logarithm of std_m, in their order.
  std::vector<double> scores(const NoiseShape& shape, double outliers) const;
  /// Probability that noise lies beyond the window.
  double beyondWindow(const NoiseShape& shape) const;

 private:
  double cumulative(double at_m, double std_m) const;
  double cumulative(double at_m, const NoiseShape& shape) const;
  /// Logarithms of the probabilities of the bins.
  std::vector<double> logProbabilities(const NoiseShape& shape, double outliers) const;

  Sample kind_;
  double quantum_m_, window_m_, width_m_ = 0;
  std::size_t size_;
  std::vector<long> bins_;           ///< numbers of those that are not empty, ascending
  std::vector<double> counts_;       ///< values in each of them
  std::vector<std::size_t> bin_of_;  ///< by value: index in bins_
  double median_m_ = 0;              ///< of the absolute values
};

}  // namespace robosim
