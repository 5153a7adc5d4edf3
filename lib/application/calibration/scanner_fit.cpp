#include "calibration/scanner_fit.h"

#include <cmath>

#include "base/angle_units.h"
#include "base/error_list.h"
#include "base/printable_text.h"
#include "base/progress.h"
#include "base/text_table.h"
#include "base/xml_element.h"
#include "calibration/map_residuals.h"
#include "calibration/simulated_pairs.h"

namespace robosim {
namespace {

/// Simulated pairs for each held-out one: as many as give about this number of differences.
constexpr std::size_t kSimulatedDifferences = 200'000, kSimulatedPerPairMin = 4, kSimulatedPerPairMax = 40;
/// Simulated readings for each held-out one of a drive.
constexpr std::size_t kSimulatedPerReading = 4;
constexpr std::uint64_t kSeed = 1;

/// Every second pair of `all`, from `first` on.
std::vector<ScanPair> everySecond(const std::vector<ScanPair>& all, std::size_t first) {
  std::vector<ScanPair> some;
  for (std::size_t i = first; i < all.size(); i += 2) some.push_back(all[i]);
  return some;
}

/// Range at which a white surface's echo is detected, so that all surfaces seen steadily can be modelled.
double reachFor(const std::vector<SeenSurface>& seen, double fading) {
  double farthest_m = 0;
  for (const auto& surface : seen) farthest_m = std::max(farthest_m, surface.range_m);
  constexpr double kSteadyScales = 10;  // of the logarithm of the power: 5e-5 of the echoes are lost
  return std::ceil(farthest_m * std::exp(kSteadyScales * fading / 2));
}

std::vector<ExpectedReading> expectedReadings(const ScanSeries& series, const std::vector<ScanPair>& pairs,
                                              const LostEchoes& echoes, double jump_m) {
  std::vector<ExpectedReading> readings;
  for (const auto& group : standingGroups(series, pairs)) {
    const auto seen = seenSurfaces(series, group, echoes, jump_m);
    std::size_t next = 0;
    for (const auto& pair : group) {
      for (std::size_t scan = std::max(pair.first, next); scan <= pair.first + 1; ++scan) {
        next = scan + 1;
        for (std::size_t i = 0; i < seen.size(); ++i) {
          if (seen[i].range_m > 0) readings.push_back({series.scans[scan].ranges_m[i], seen[i].range_m});
        }
      }
    }
  }
  return readings;
}

/// A model of the scans at rest of pairs, with the errors of the equivalent scene.
struct StandingModel {
  LaserFit fit;
  LostEchoes echoes;
  LaserErrors scene;  ///< the same errors, with a reach at which the flickering of all beams can be modelled
};

StandingModel modelOf(const ScanSeries& series, const std::vector<ScanPair>& pairs, double quantum_m, double jump_m) {
  const PairStatistics statistics = computeStatistics(series, pairs, jump_m);
  StandingModel model{.fit = fitLaser(statistics, quantum_m), .echoes = countLostEchoes(series, pairs), .scene = {}};
  LaserFit& fit = model.fit;
  fit.errors.dropout = model.echoes.dropout;
  fit.dropout = model.echoes.interval;
  // An outlier is read also where the echo of the surface would not have been detected, so that the share s of outliers
  // among the compared readings exceeds their rate r among all readings. Of a beam with the share v of valid readings,
  // v² of the pairs are compared: s = Σ v² (r / v) / Σ v², and Σ 2 v (1 - v) pairs change their validity.
  const auto compared = static_cast<double>(statistics.compared);
  const double kept = compared / std::max(1.0, compared + static_cast<double>(statistics.flips) / 2);
  fit.errors.outlier *= kept;
  fit.outlier = {fit.outlier.low * kept, fit.outlier.high * kept};
  fit.errors.fading = 0.1;
  fit.errors.reach_m = model.echoes.reach_m;
  fit.reach_m = model.echoes.reach;
  model.scene = fit.errors;
  model.scene.reach_m = 0;
  bool flickers = false;
  for (const auto& group : standingGroups(series, pairs)) {
    const auto seen = seenSurfaces(series, group, model.echoes, jump_m);
    for (const auto& surface : seen) flickers = flickers || (surface.valid > 0 && surface.valid < 1);
    model.scene.reach_m = std::max(model.scene.reach_m, reachFor(seen, fit.errors.fading));
  }
  if (!flickers) model.scene.reach_m = 0;
  return model;
}

/// Fits the errors to the pairs of scans at rest.
void fitPairs(ScannerFit& fit, Progress& progress) {
  progress.show("fitting …");
  const double quantum_m = estimateQuantum(fit.series), jump_m = computeJumpLimit(fit.series, fit.used, quantum_m);
  const StandingModel model = modelOf(fit.series, fit.used, quantum_m, jump_m);
  fit.model = model.fit;
  fit.echoes = model.echoes;
  for (std::size_t i = 0; i < fit.folds.size(); ++i) {
    progress.show("comparing with held-out pairs …");
    HeldOutFit& fold = fit.folds[i];
    fold.fitted = everySecond(fit.used, i);
    fold.held_out = everySecond(fit.used, 1 - i);
    const StandingModel half = modelOf(fit.series, fold.fitted, quantum_m, jump_m);
    fold.model = half.fit;
    fold.real = computeStatistics(fit.series, fold.held_out, jump_m);
    const std::size_t count = std::clamp(kSimulatedDifferences / std::max<std::size_t>(1, fold.real.beams),
                                         kSimulatedPerPairMin, kSimulatedPerPairMax);
    fold.simulated = simulatePairs(fit.series, fold.fitted, half.scene, half.echoes, jump_m, count, kSeed + i);
  }
}

/// Beam models of the scans at rest, and of all scans about the local map, which are reported only.
void fitBeamModels(ScannerFit& fit, Progress& progress) {
  fit.beam_model =
      fitBeamModel(expectedReadings(fit.series, fit.used, fit.echoes, fit.real.jump_m), fit.series.range_max_m);
  progress.show("matching scans …");
  fit.map_readings = matchScans(fit.series);
  if (!fit.map_readings.readings.empty()) {
    fit.map_model = fitBeamModel(fit.map_readings.readings, fit.series.range_max_m);
  }
}

/// Fits the errors to the residuals of all scans about the local map.
void fitDrive(ScannerFit& fit, const std::string& rawlog, Progress& progress) {
  progress.show("matching scans …");
  fit.map_readings = matchScans(fit.series, MapRange::mean);
  if (fit.map_readings.matched < kFewestMatchedScans) {
    throw ConfigError(rawlog + ": has " + std::to_string(fit.used.size()) + " pairs of scans at rest of '" +
                      quotable(fit.series.label) + "', of " + std::to_string(fit.series.scans.size()) + " scans, and " +
                      std::to_string(fit.map_readings.matched) + " scans that can be aligned with those before them; " +
                      std::to_string(kFewestPairs) + " pairs or " + std::to_string(kFewestMatchedScans) +
                      " aligned scans are required, so record the scanner while the robot stands, or longer while it " +
                      "drives among walls" + (fit.candidates.size() >= kFewestPairs ? ", or use --rest odometry" : ""));
  }
  progress.show("fitting …");
  const double quantum_m = estimateQuantum(fit.series), range_max_m = fit.series.range_max_m;
  std::vector<double> residuals_m;
  for (const auto& reading : fit.map_readings.readings) {
    if (!std::isnan(reading.read_m)) residuals_m.push_back(reading.read_m - reading.expected_m);
  }
  const double jump_m = computeJumpLimit(std::move(residuals_m), quantum_m);
  fit.model = fitResiduals(computeResiduals(fit.map_readings.readings, jump_m, range_max_m), quantum_m);
  fit.map_model = fitBeamModel(fit.map_readings.readings, range_max_m);
  for (std::size_t i = 0; i < fit.folds.size(); ++i) {
    progress.show("comparing with held-out scans …");
    HeldOutFit& fold = fit.folds[i];
    const auto held_out = readingsOfScans(fit.map_readings, 1 - i, 2);
    fold.model =
        fitResiduals(computeResiduals(readingsOfScans(fit.map_readings, i, 2), jump_m, range_max_m), quantum_m);
    fold.real = computeResiduals(held_out, jump_m, range_max_m);
    fold.simulated =
        simulateResiduals(held_out, fold.model.errors, jump_m, range_max_m, kSimulatedPerReading, kSeed + i);
  }
}

std::string describeBasis(const ScannerFit& fit) {
  if (fit.basis == FitBasis::scans_at_rest) return std::to_string(fit.used.size()) + " pairs of scans at rest";
  return "the residuals of " + withCommas(fit.map_readings.matched) + " scans about the map of the scans before them";
}

std::string boundsOf(const ScannerFit& fit) {
  if (fit.basis == FitBasis::scans_at_rest) return "";
  return ", which contain errors of the motion and of the map: upper bounds of the scanner's own errors";
}

std::string textOf(const BeamModel& b) {
  return "z_hit " + fixed(b.z_hit, 4) + " (" + fixed(b.sigma_hit_m, 4) + " m), z_short " + fixed(b.z_short, 4) + " (" +
         fixed(b.lambda_short_per_m, 3) + "/m), z_max " + fixed(b.z_max, 4) + ", z_rand " + fixed(b.z_rand, 4);
}

std::string percent(double share) { return fixed(100 * share, 2) + " %"; }

std::string rangeOf(const ConfidenceInterval& interval, double scale, int digits) {
  return " (" + fixed(scale * interval.low, digits) + " … " + fixed(scale * interval.high, digits) + ")";
}

std::string reachText(const ScannerFit& fit) {
  if (fit.basis == FitBasis::local_map) return "unknown from a drive; none is written";
  if (fit.model.errors.reach_m == 0) {
    return "not bounded by the recording, because no beam flickers; none is written. Farthest echo " +
           fixed(fit.echoes.farthest_m, 1) + " m";
  }
  return fixed(fit.model.errors.reach_m, 1) + " m" + rangeOf(fit.model.reach_m, 1, 1) +
         " for a reflectivity × cos(incidence) of 0.5 (1 … 0.1) of the farthest flickering surface";
}

/// The parameters with intervals of 95 %, one a line.
std::string parametersOf(const ScannerFit& fit, const std::string& indent) {
  const LaserFit& m = fit.model;
  std::string text;
  for (std::size_t band = 0; band < kBands; ++band) {
    if (m.std_m[band] == 0) continue;
    text += indent + "std " + bandName(band) + ": " + fixed(1000 * m.std_m[band], 2) +
            rangeOf(m.std_interval_m[band], 1000, 2) + " mm\n";
  }
  text += indent + "tail: " + fixed(m.errors.tail, 3) + rangeOf(m.tail, 1, 3);
  if (m.errors.tail > 0) text += " × " + fixed(m.errors.tail_factor, 0) + rangeOf(m.tail_factor, 1, 0);
  text += "\n" + indent + "dropout: " + fixed(100 * m.errors.dropout, 3) + rangeOf(m.dropout, 100, 3) + " %\n";
  text += indent + "outlier: " + fixed(100 * m.errors.outlier, 3) + rangeOf(m.outlier, 100, 3) + " %\n";
  return text + indent + "reach: " + reachText(fit) + "\n";
}

}  // namespace

double ScannerFit::comparisonLevel() const {
  std::size_t comparisons = 4;  // rates
  for (const auto& differences_m : real.differences_m) comparisons += !differences_m.empty();
  return kVerdictLevel / static_cast<double>(comparisons);
}

double ScannerFit::computeKs(const PairStatistics& held_out, const PairStatistics& of_model, std::size_t band) const {
  const double quantum_m = model.errors.quantum_m;
  return ksDistance(dequantised(held_out.differences_m[band], quantum_m, kSeed),
                    dequantised(of_model.differences_m[band], quantum_m, kSeed + 1));
}

double ScannerFit::computeKsBound(std::size_t band) const {
  return ksBound(real.differences_m[band].size(), simulated.differences_m[band].size(), comparisonLevel());
}

bool ScannerFit::isBeyondBound(const HeldOutFit& half, std::size_t band) const {
  return !half.real.differences_m[band].empty() &&
         computeKs(half.real, half.simulated, band) > half.computeKsBound(band);
}

bool ScannerFit::isAccepted() const {
  for (std::size_t band = 0; band < kBands; ++band) {
    if (!real.differences_m[band].empty() && computeKs(band) > computeKsBound(band)) return false;
  }
  for (const auto& fold : folds) {
    if (isJumpRateBeyond(fold, comparisonLevel()) || isFlipRateBeyond(fold, comparisonLevel())) return false;
  }
  return true;
}

ScannerFit fitScans(ScanSeries series, RestCriterion criterion, const std::string& name, Progress& progress) {
  ScannerFit fit;
  fit.criterion = criterion;
  fit.series = std::move(series);
  fit.candidates = standingPairs(fit.series);
  for (const auto& pair : fit.candidates) {
    if (criterion == RestCriterion::odometry || pair.is_at_rest) fit.used.push_back(pair);
  }
  if (fit.used.size() < kFewestPairs) {
    fit.basis = FitBasis::local_map;
    fitDrive(fit, name, progress);
  } else {
    fitPairs(fit, progress);
  }
  fit.real.jump_m = fit.simulated.jump_m = fit.folds[0].real.jump_m;
  for (const auto& fold : fit.folds) {
    fit.real.add(fold.real);
    fit.simulated.add(fold.simulated);
  }
  return fit;
}

ScannerFit fitScanner(const std::string& rawlog, const std::string& sensor, RestCriterion criterion) {
  Progress progress;
  const Interrupt interrupt;
  ScannerFit fit = fitScans(readScans(rawlog, sensor,
                                      [&](std::uint64_t entries) {
                                        throwIfInterrupted("nothing was written");
                                        if (progress.due()) {
                                          progress.show("reading: " + withCommas(entries) + " entries …");
                                        }
                                      }),
                            criterion, rawlog, progress);
  if (fit.basis == FitBasis::scans_at_rest) fitBeamModels(fit, progress);
  return fit;
}

std::string modelXml(const ScannerFit& fit, const std::string& rawlog) {
  const LaserErrors& e = fit.model.errors;
  XmlElement laser{"laser", "", {}, {}, {}};
  const std::size_t beams = fit.series.scans.front().ranges_m.size();
  const double field_deg = toDegrees(fit.series.step_rad * static_cast<double>(beams - 1));
  laser.attributes = {{"beams", std::to_string(beams)}};
  if (field_deg > 0 && field_deg <= 360) laser.attributes.emplace_back("field_of_view_deg", fixed(field_deg, 4));
  if (fit.series.range_max_m > 0 && fit.series.range_max_m <= 1000) {
    laser.attributes.emplace_back("range_max_m", fixed(fit.series.range_max_m, 3));
  }
  XmlElement& noise = laser.add("noise");
  const auto set = [&](const char* name, double value, int digits) {
    noise.attributes.emplace_back(name, fixed(value, digits));
  };
  set("tail", e.tail, 4);
  set("tail_factor", e.tail_factor, 1);
  set("quantum_m", e.quantum_m, 4);
  set("dropout", e.dropout, 6);
  set("outlier", e.outlier, 6);
  if (e.reach_m > 0) {  // otherwise the recording does not bound it
    set("reach_m", e.reach_m, 1);
    set("fading", e.fading, 3);
  }
  for (const auto& at : e.std_at) {
    XmlElement& point = noise.add("at");
    point.attributes = {{"range_m", fixed(at.range_m, 2)}, {"std_m", fixed(at.std_m, 5)}};
  }
  std::string name = rawlog.substr(rawlog.find_last_of('/') + 1);
  for (std::size_t at = name.find("--"); at != std::string::npos; at = name.find("--")) name.erase(at, 1);
  std::string text = toXml(laser);
  const std::string comment = "<!-- Fitted to " + describeBasis(fit) + " of " + name + boundsOf(fit) +
                              ". In the <sensors> of a robot type: <include file=\"laser.xml\" z_m=\"0.3\"/>\n" +
                              "     Estimates with intervals of 95 %:\n" + parametersOf(fit, "     ") + "-->\n";
  return text.insert(text.find('\n') + 1, comment);  // after the declaration
}

std::string summaryOf(const ScannerFit& fit) {
  const bool is_at_rest = fit.basis == FitBasis::scans_at_rest;
  std::string text = "scanner   '" + fit.series.label + "', " + withCommas(fit.series.scans.size()) + " scans of " +
                     std::to_string(fit.series.scans.front().ranges_m.size()) + " beams\nat rest   " +
                     std::to_string(fit.used.size()) + " pairs of scans; " +
                     std::to_string(fit.candidates.size() - fit.used.size()) +
                     " excluded, because the scans contradict the odometry\n";
  if (!is_at_rest) text += "fitted    to " + describeBasis(fit) + boundsOf(fit) + "\n";
  text += "errors    quantum " + fixed(fit.model.errors.quantum_m, 3) + " m; with intervals of 95 %:\n" +
          parametersOf(fit, "          ");
  if (is_at_rest) text += "beams     " + textOf(fit.beam_model) + ", about their mean ranges at rest\n";
  text += "map       " + textOf(fit.map_model) + ", of " + withCommas(fit.map_readings.matched) +
          " scans against the aligned scans before them; " + withCommas(fit.map_readings.failed) + " not aligned\n\n";
  const std::string parts = is_at_rest ? "pairs" : "scans";
  std::string beyond;  // halves
  Rows rows{{"held out", "std", "real", "simulated", "KS", "bound", "KS, odd", "bound", "KS, even", "bound"}};
  for (std::size_t band = 0; band < kBands; ++band) {
    const std::size_t n = fit.real.differences_m[band].size();
    if (n == 0) continue;
    rows.push_back({bandName(band), fit.model.std_m[band] > 0 ? fixed(1000 * fit.model.std_m[band], 1) + " mm" : "–",
                    withCommas(n), withCommas(fit.simulated.differences_m[band].size()),
                    fixed(fit.computeKs(band), 3) + (fit.computeKs(band) > fit.computeKsBound(band) ? " !" : ""),
                    fixed(fit.computeKsBound(band), 3)});
    for (std::size_t half = 0; half < fit.folds.size(); ++half) {
      const HeldOutFit& fold = fit.folds[half];
      const bool is_beyond = fit.isBeyondBound(fold, band);
      rows.back().push_back(fixed(fit.computeKs(fold.real, fold.simulated, band), 3) + (is_beyond ? " !" : ""));
      rows.back().push_back(fixed(fold.computeKsBound(band), 3));
      if (!is_beyond) continue;
      beyond +=
          (beyond.empty() ? "" : ", ") + std::string(half == 0 ? "odd " : "even ") + parts + " at " + bandName(band);
    }
  }
  text += table(rows);
  const std::string jump = fixed(100 * fit.real.jump_m, 0) + " cm";
  rows = {{"share of the beams", "odd, real", "simulated", "bound", "even, real", "simulated", "bound"}};
  using BeyondBound = bool (*)(const HeldOutFit&, double);
  const double level = fit.comparisonLevel();
  const auto add = [&](const std::string& name, double (PairStatistics::*rate)() const,
                       double (HeldOutFit::*bound)(double) const, BeyondBound is_beyond) {
    rows.push_back({name});
    for (const auto& fold : fit.folds) {
      rows.back().push_back(percent((fold.real.*rate)()) + (is_beyond && is_beyond(fold, level) ? " !" : ""));
      rows.back().push_back(percent((fold.simulated.*rate)()));
      rows.back().push_back(bound ? "±" + percent((fold.*bound)(level)) : "–");
    }
  };
  add((is_at_rest ? "jumps above " : "residuals above ") + jump, &PairStatistics::jumpRate, &HeldOutFit::jumpBound,
      isJumpRateBeyond);
  add(is_at_rest ? "changes of validity" : "lost echoes", &PairStatistics::flipRate, &HeldOutFit::flipBound,
      isFlipRateBeyond);
  if (is_at_rest) add("invalid in both", &PairStatistics::invalidRate, nullptr, nullptr);
  text += "\n" + table(rows) + "\nThe held-out " + parts +
          (fit.isAccepted() ? " agree with the model.\n"
                            : " differ from the model: the figures marked with ! exceed their bounds.\n");
  if (!beyond.empty()) text += "! One half alone exceeds its bound: " + beyond + ".\n";
  return text;
}

}  // namespace robosim
