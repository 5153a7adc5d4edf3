#include "calibration/laser_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/error_list.h"
#include "base/interrupt.h"
#include "calibration/binned_sample.h"

namespace robosim {
namespace {

constexpr std::array kTails{0.0, 0.005, 0.01, 0.02, 0.03, 0.05, 0.075, 0.1, 0.15, 0.2, 0.3};
constexpr std::array kFactors{2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0};
constexpr double kTailMax = 1, kFactorMax = 100;  // of LaserErrors
/// 95 % quantile of χ² with one degree of freedom, and 99 % quantile of that with two.
constexpr double kChiSquare95 = 3.841, kChiSquare99OfTwo = 9.210;

/// The best σ of a band for a shape.
struct BandStd {
  double std_m = 0;
  double likelihood = 0;
  double curvature = 0;  ///< negative second derivative of the likelihood by the logarithm of σ
};

/// Newton's method for the logarithm of σ, from `start_m` on.
BandStd bestStd(const BinnedSample& sample, NoiseShape shape, double outliers, double start_m) {
  constexpr double kStep = 0.02, kFarthest = 0.5, kConverged = 1e-4;
  constexpr int kIterations = 25;
  const double least = std::log(sample.binWidth() / 50);
  const auto at = [&](double log_std) {
    shape.std_m = std::exp(log_std);
    return sample.logLikelihood(shape, outliers);
  };
  double x = std::log(start_m);
  BandStd best;
  for (int i = 0; i < kIterations; ++i) {
    const double low = at(x - kStep), here = at(x), high = at(x + kStep);
    const double slope = (high - low) / (2 * kStep), bend = (high - 2 * here + low) / (kStep * kStep);
    best = {std::exp(x), here, std::max(0.0, -bend)};
    double step = bend < 0 ? -slope / bend : std::copysign(kFarthest, slope);
    step = std::clamp(step, -kFarthest, kFarthest);
    const double next = std::max(least, x + step);
    if (std::abs(next - x) < kConverged) break;
    x = next;
  }
  return best;
}

/// One combination of tail and factor.
struct TailFit {
  std::size_t tail = 0, factor = 0;  ///< indices in kTails and kFactors
  std::array<BandStd, kBands> bands{};
  double likelihood = 0;
};

struct BandSample {
  std::size_t band = 0;
  BinnedSample sample;
};

double middleOf(std::size_t band) {
  return band + 1 < kBands ? (kBandLimits_m[band] + kBandLimits_m[band + 1]) / 2 : kBandLimits_m[band] * 1.5;
}

/// By how much pairs share scans: 0 for disjoint pairs, 1 if each scan is in two.
double computeOverlap(const PairStatistics& statistics) {
  std::set<std::uint32_t> pairs;
  std::size_t adjacent = 0;
  for (const auto& origins : statistics.origins) {
    for (const auto& origin : origins) pairs.insert(origin.pair);
  }
  for (const auto pair : pairs) adjacent += pairs.contains(pair + 1);
  return pairs.empty() ? 0 : static_cast<double>(adjacent) / static_cast<double>(pairs.size());
}

class SampleFit {
 public:
  SampleFit(Sample kind, const PairStatistics& statistics, double quantum_m)
      : kind_(kind), statistics_(statistics), quantum_m_(quantum_m) {
    for (std::size_t band = 0; band < kBands; ++band) {
      const auto& differences_m = statistics.differences_m[band];
      if (differences_m.size() < kFewestDifferences) continue;
      bands_.push_back({band, BinnedSample(kind, differences_m, quantum_m, statistics.jump_m)});
      differences_ += static_cast<double>(differences_m.size());
    }
    if (!bands_.empty()) return;
    const bool is_at_rest = kind == Sample::differences;
    throw ConfigError(std::string(is_at_rest ? "the scans at rest have" : "half of the scans have") + " fewer than " +
                      std::to_string(kFewestDifferences) + " ranges in every band; use a longer recording" +
                      (is_at_rest ? " of a scanner at rest" : ""));
  }

  LaserFit fit() {
    // Share of outliers whose difference is no jump, if they are uniform up to the maximum range.
    const double window = statistics_.range_max_m > 0 && statistics_.differences() > 0
                              ? statistics_.outlier_window / static_cast<double>(statistics_.differences())
                              : 0;
    const auto affectedBy = [&](double jump_share, double noise_jumps) {
      return std::clamp((jump_share - noise_jumps) / std::max(1e-9, 1 - window - noise_jumps), 0.0, 1.0);
    };
    double noise_jumps = 0;
    for (int i = 0; i < 2; ++i) {
      const double affected = affectedBy(statistics_.jumpRate(), noise_jumps);
      const double inside = affected * window + (1 - affected) * (1 - noise_jumps);
      search(inside > 0 ? affected * window / inside : 0);
      noise_jumps = noiseJumps();
    }
    LaserFit fit;
    fit.errors.quantum_m = quantum_m_;
    fit.errors.tail = kTails[chosen_.tail];
    fit.errors.tail_factor = fit.errors.tail > 0 ? kFactors[chosen_.factor] : LaserErrors().tail_factor;
    setNoise(fit);
    const double effect = jumpEffect();
    const auto n = static_cast<double>(statistics_.compared), jumps = static_cast<double>(statistics_.jumps);
    const ConfidenceInterval share = binomialInterval(jumps / effect, n / effect);
    const auto ofReadings = [&](double jump_share) {
      const double affected = affectedBy(jump_share, noise_jumps);
      return kind_ == Sample::differences ? 1 - std::sqrt(1 - affected) : affected;
    };
    fit.errors.outlier = ofReadings(statistics_.jumpRate());
    fit.outlier = {ofReadings(share.low), ofReadings(share.high)};
    return fit;
  }

 private:
  /// Searches tail, factor and σ of each band.
  void search(double outliers) {
    outliers_ = outliers;
    fits_.clear();
    std::array<double, kBands> start_m{};
    for (const auto& [band, sample] : bands_) start_m[band] = sample.roughStd();
    for (std::size_t tail = 0; tail < kTails.size(); ++tail) {
      for (std::size_t factor = 0; factor < (tail == 0 ? 1 : kFactors.size()); ++factor) {
        throwIfInterrupted("nothing was written");
        TailFit fit{.tail = tail, .factor = factor};
        for (const auto& [band, sample] : bands_) {
          fit.bands[band] = bestStd(sample, {0, kTails[tail], kFactors[factor]}, outliers, start_m[band]);
          start_m[band] = fit.bands[band].std_m;
          fit.likelihood += fit.bands[band].likelihood;
        }
        fits_.push_back(fit);
      }
    }
    chosen_ = fits_.front();
    measureEffects();
    best_ = *std::max_element(fits_.begin(), fits_.end(),
                              [](const TailFit& a, const TailFit& b) { return a.likelihood < b.likelihood; });
    // Errors that a pair of scans has in common widen the intervals; they are no reason against a tail.
    const double overlap = kind_ == Sample::differences ? computeOverlap(statistics_) : 0;
    if (2 * (best_.likelihood - fits_.front().likelihood) / (1 + overlap) > kChiSquare99OfTwo) {
      chosen_ = best_;
      measureEffects();
    }
  }

  /// Design effects at the chosen fit. If each scan is in two pairs, the variance of a mean of squared differences is
  /// 1 + 2 (1/2)² times that of independent ones, and a reading of the tail affects two differences.
  void measureEffects() {
    const double overlap = kind_ == Sample::differences ? computeOverlap(statistics_) : 0;
    tail_effect_ = 1 + overlap;
    for (const auto& [band, sample] : bands_) {
      const auto scores = sample.scores(shapeOf(band), outliers_);
      std::vector<DependentTerm> terms;
      for (std::size_t i = 0; i < scores.size(); ++i) terms.push_back({statistics_.origins[band][i], scores[i]});
      effects_[band] = std::max(1 + overlap / 2, designEffect(terms, chosen_.bands[band].curvature));
      tail_effect_ = std::max(tail_effect_, effects_[band]);
    }
  }

  NoiseShape shapeOf(std::size_t band) const {
    return {chosen_.bands[band].std_m, kTails[chosen_.tail], kFactors[chosen_.factor]};
  }

  /// Share of the differences that are jumps although none of their readings is an outlier.
  double noiseJumps() const {
    double sum = 0;
    for (const auto& [band, sample] : bands_) {
      sum += static_cast<double>(sample.size()) * sample.beyondWindow(shapeOf(band));
    }
    return sum / differences_;
  }

  void setNoise(LaserFit& fit) const {
    const bool has_tail = fit.errors.tail > 0;
    fit.tail = {fit.errors.tail, fit.errors.tail};
    fit.tail_factor = {fit.errors.tail_factor, fit.errors.tail_factor};
    for (const auto& [band, sample] : bands_) {
      fit.std_m[band] = chosen_.bands[band].std_m;
      fit.errors.std_at.push_back({middleOf(band), fit.std_m[band]});
      fit.std_interval_m[band] = {fit.std_m[band], fit.std_m[band]};
    }
    for (const auto& other : fits_) {
      const double lack = std::max(0.0, 2 * (best_.likelihood - other.likelihood) / tail_effect_);
      const bool is_chosen = other.tail == chosen_.tail && other.factor == chosen_.factor;
      if (lack > kChiSquare95 && !is_chosen) continue;
      const double rest = is_chosen ? kChiSquare95 : kChiSquare95 - lack;
      // The limits lie between values of the grid.
      fit.tail.low = std::min(fit.tail.low, other.tail < 2 ? 0 : kTails[other.tail - 1]);
      fit.tail.high = std::max(fit.tail.high, other.tail + 1 < kTails.size() ? kTails[other.tail + 1] : kTailMax);
      if (has_tail && other.tail > 0) {
        fit.tail_factor.low = std::min(fit.tail_factor.low, other.factor == 0 ? 1 : kFactors[other.factor - 1]);
        fit.tail_factor.high = std::max(fit.tail_factor.high,
                                        other.factor + 1 < kFactors.size() ? kFactors[other.factor + 1] : kFactorMax);
      }
      for (const auto& [band, sample] : bands_) {
        const BandStd& std = other.bands[band];
        const double half = std.curvature > 0 ? std::sqrt(effects_[band] * rest / std.curvature) : 1;
        ConfidenceInterval& interval = fit.std_interval_m[band];
        interval.low = std::min(interval.low, std.std_m * std::exp(-half));
        interval.high = std::max(interval.high, std.std_m * std::exp(half));
      }
    }
  }

  /// Design effect of the number of jumps: an outlier makes two of the differences of overlapping pairs jumps.
  double jumpEffect() const {
    const double share = statistics_.jumpRate();
    std::vector<DependentTerm> terms;
    for (const auto& origin : statistics_.jump_origins) terms.push_back({origin, 1 - share});
    for (const auto& origins : statistics_.origins) {
      for (const auto& origin : origins) terms.push_back({origin, -share});
    }
    const double least = 1 + (kind_ == Sample::differences ? computeOverlap(statistics_) : 0);
    return std::max(least, designEffect(terms, static_cast<double>(statistics_.compared) * share * (1 - share)));
  }

  Sample kind_;
  const PairStatistics& statistics_;
  double quantum_m_;
  double differences_ = 0, outliers_ = 0, tail_effect_ = 1;
  std::vector<BandSample> bands_;
  std::vector<TailFit> fits_;
  TailFit best_, chosen_;
  std::array<double, kBands> effects_{};
};

}  // namespace

LaserFit fitLaser(const PairStatistics& statistics, double quantum_m) {
  return SampleFit(Sample::differences, statistics, quantum_m).fit();
}

LaserFit fitResiduals(const PairStatistics& residuals, double quantum_m) {
  LaserFit fit = SampleFit(Sample::residuals, residuals, quantum_m).fit();
  fit.errors.dropout = residuals.flipRate();
  fit.dropout = binomialInterval(static_cast<double>(residuals.flips), static_cast<double>(residuals.beams));
  fit.errors.outlier *= 1 - fit.errors.dropout;
  return fit;
}

}  // namespace robosim
