#include "calibration/lost_echoes.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

constexpr std::size_t kFewestScans = 5;

/// Echoes of a beam at one place.
struct BeamEchoes {
  std::size_t lost = 0, scans = 0;
  double range_m = 0;
};

double logBinomial(std::size_t lost, std::size_t scans, double rate) {
  const auto k = static_cast<double>(lost), n = static_cast<double>(scans);
  const double p = std::clamp(rate, 1e-12, 1 - 1e-12);
  return std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1) + k * std::log(p) + (n - k) * std::log(1 - p);
}

/// Probability that a beam is steady.
double steadyShare(const BeamEchoes& beam, double rate, double flickering) {
  const double steady = (1 - flickering) * std::exp(logBinomial(beam.lost, beam.scans, rate));
  const double other = flickering / static_cast<double>(beam.scans + 1);
  return steady + other > 0 ? steady / (steady + other) : 0;
}

struct MixtureFit {
  double rate = 0, flickering = 0, likelihood = 0;
};

double computeLikelihood(const std::vector<BeamEchoes>& beams, double rate, double flickering) {
  double sum = 0;
  for (const auto& beam : beams) {
    sum += std::log(std::max(1e-300, (1 - flickering) * std::exp(logBinomial(beam.lost, beam.scans, rate)) +
                                         flickering / static_cast<double>(beam.scans + 1)));
  }
  return sum;
}

MixtureFit maximise(const std::vector<BeamEchoes>& beams, double rate) {
  constexpr int kIterations = 200;
  double flickering = 0.1;
  for (int i = 0; i < kIterations; ++i) {
    double lost = 0, scans = 0, steady = 0;
    for (const auto& beam : beams) {
      const double share = steadyShare(beam, rate, flickering);
      lost += share * static_cast<double>(beam.lost);
      scans += share * static_cast<double>(beam.scans);
      steady += share;
    }
    if (scans > 0) rate = lost / scans;
    flickering = 1 - steady / static_cast<double>(beams.size());
  }
  return {rate, flickering, computeLikelihood(beams, rate, flickering)};
}

void estimateReach(const std::vector<BeamEchoes>& beams, LostEchoes& echoes) {
  constexpr double kUsual = 0.5, kDarkest = 0.1;  // reflectivity × cos(incidence)
  double flickers_m = 0;
  for (const auto& beam : beams) {
    echoes.farthest_m = std::max(echoes.farthest_m, beam.range_m);
    if (!echoes.isSteady(beam.lost, beam.scans)) flickers_m = std::max(flickers_m, beam.range_m);
  }
  if (flickers_m == 0) return;
  echoes.reach = {echoes.farthest_m, std::max(echoes.farthest_m, flickers_m / std::sqrt(kDarkest))};
  echoes.reach_m = std::clamp(flickers_m / std::sqrt(kUsual), echoes.reach.low, echoes.reach.high);
}

}  // namespace

bool LostEchoes::isSteady(std::size_t lost, std::size_t scans) const {
  return flickering == 0 || steadyShare({lost, scans, 0}, dropout, flickering) >= 0.5;
}

LostEchoes countLostEchoes(const ScanSeries& series, const std::vector<ScanPair>& pairs) {
  std::vector<BeamEchoes> beams;
  double lost = 0, all = 0;
  for (const auto& group : standingGroups(series, pairs)) {
    const auto scans = listScans(group);
    if (scans.size() < kFewestScans) continue;
    const auto range_m = medianRanges(series, group);
    for (std::size_t i = 0; i < range_m.size(); ++i) {
      BeamEchoes beam{.lost = 0, .scans = scans.size(), .range_m = range_m[i]};
      for (const std::size_t scan : scans) beam.lost += std::isnan(series.scans[scan].ranges_m[i]) ? 1 : 0;
      if (beam.lost == beam.scans) continue;
      lost += static_cast<double>(beam.lost);
      all += static_cast<double>(beam.scans);
      beams.push_back(beam);
    }
  }
  LostEchoes echoes;
  if (beams.empty()) return echoes;
  echoes.dropout = lost / all;
  std::vector<double> shares;
  for (const auto& beam : beams) shares.push_back(static_cast<double>(beam.lost) / static_cast<double>(beam.scans));
  std::nth_element(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2), shares.end());
  // The likelihood may have several maxima: from the median of the beams, from few losses, and from all of them.
  MixtureFit best{.rate = echoes.dropout, .flickering = 0, .likelihood = computeLikelihood(beams, echoes.dropout, 0)};
  constexpr double kSignificant = 10.83 / 2;  // 99.9 % quantile of χ² with one degree of freedom
  const double without = best.likelihood;
  for (const double start : {shares[shares.size() / 2], 0.5 / static_cast<double>(beams.front().scans), best.rate}) {
    const MixtureFit fit = maximise(beams, start);
    if (fit.likelihood > best.likelihood && fit.likelihood > without + kSignificant) best = fit;
  }
  echoes.dropout = best.rate;
  echoes.flickering = best.flickering;
  lost = all = 0;
  double squares = 0, steady_beams = 0;
  for (const auto& beam : beams) {
    const double share = steadyShare(beam, best.rate, best.flickering);
    const auto k = static_cast<double>(beam.lost), n = static_cast<double>(beam.scans);
    lost += share * k;
    all += share * n;
    steady_beams += share;
    if (best.rate > 0) squares += share * std::pow(k - n * best.rate, 2) / (n * best.rate * (1 - best.rate));
  }
  const double effect = std::max(1.0, steady_beams > 1 ? squares / (steady_beams - 1) : 1.0);
  echoes.interval = binomialInterval(lost / effect, all / effect);
  estimateReach(beams, echoes);
  return echoes;
}

}  // namespace robosim
