#pragma once
#include <cstddef>
#include <functional>
#include <vector>

#include "calibration/pair_statistics.h"

namespace robosim {

/// Limits between which a parameter lies with a probability of 95 %.
struct ConfidenceInterval {
  double low = 0, high = 0;
  bool contains(double value) const { return low <= value && value <= high; }
};

/// 95 % interval of a probability from `hits` in `trials`, neither necessarily whole numbers (Clopper & Pearson, "The
/// use of confidence or fiducial limits illustrated in the case of the binomial", Biometrika 26, 1934). [0, 1] without
/// trials.
ConfidenceInterval binomialInterval(double hits, double trials);

/// The value that a standard normal variable exceeds in absolute value with a probability `level`.
double normalBound(double level);

/// A term of a sum that has expectation 0, such as a score, and where it comes from.
struct DependentTerm {
  DifferenceOrigin origin;
  double value = 0;
};

/// Variance of the sum of the terms divided by `independent`, the variance for independent ones: the larger one of two
/// estimates, of terms that depend on each other within a beam, and of terms that depend on each other within a pair
/// of scans and the next one (Newey & West, "A simple, positive semi-definite, heteroskedasticity and autocorrelation
/// consistent covariance matrix", Econometrica 55, 1987). 0 for fewer than five beams and pairs.
double designEffect(const std::vector<DependentTerm>& terms, double independent);

}  // namespace robosim
