#include <algorithm>
#include <cmath>

#include "base/angle_units.h"
#include "base/html_table.h"
#include "base/html_text.h"
#include "base/report_page.h"
#include "base/text_table.h"
#include "calibration/scanner_fit.h"

namespace robosim {
namespace {

constexpr int kWidth_px = 560, kHeight_px = 200, kMargin_px = 30;

constexpr double kWidest_m = 0.15;  // of the plots

constexpr const char* kHistogramStyle =
    ":root{--real:#9ecae1;--model:#c0392b}@media(prefers-color-scheme:dark){:root{--real:#2f6f96;--model:#ff8a75}}"
    ".real{fill:var(--real)}.model{fill:none;stroke:var(--model);stroke-width:1.5}.axis{stroke:var(--text)}"
    ".chart{max-width:45rem}.chart text{fill:var(--text)}";

/// Shares of the differences in bins of equal width within ±kWidest_m.
std::vector<double> computeShares(const std::vector<double>& differences_m, double bin_m) {
  const auto half = static_cast<long>(std::ceil(kWidest_m / bin_m));
  std::vector<double> shares(static_cast<std::size_t>(2 * half + 1));
  for (const double difference_m : differences_m) {
    const long bin = std::clamp(std::lround(difference_m / bin_m), -half, half);
    shares[static_cast<std::size_t>(bin + half)] += 1 / static_cast<double>(differences_m.size());
  }
  return shares;
}

/// Path of a histogram in the plot's pixels.
std::string pathOf(const std::vector<double>& shares, double largest) {
  const double step_px = static_cast<double>(kWidth_px - 2 * kMargin_px) / static_cast<double>(shares.size());
  const double floor_px = kHeight_px - kMargin_px;
  std::string path = "M" + fixed(kMargin_px, 0) + " " + fixed(floor_px, 0);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double top_px = floor_px - shares[i] / largest * (kHeight_px - 2 * kMargin_px);
    const double from_px = kMargin_px + step_px * static_cast<double>(i);
    path +=
        " L" + fixed(from_px, 1) + " " + fixed(top_px, 1) + " L" + fixed(from_px + step_px, 1) + " " + fixed(top_px, 1);
  }
  return path + " L" + fixed(kWidth_px - kMargin_px, 0) + " " + fixed(floor_px, 0);
}

std::string valuesOf(const ScannerFit& fit) {
  return fit.basis == FitBasis::scans_at_rest ? "differences" : "residuals";
}

std::string makeHistogram(const ScannerFit& fit, std::size_t band) {
  const double bin_m = std::max(fit.model.errors.quantum_m, 0.002);
  const auto real = computeShares(fit.real.differences_m[band], bin_m);
  const auto simulated = computeShares(fit.simulated.differences_m[band], bin_m);
  const double largest =
      std::max(*std::max_element(real.begin(), real.end()), *std::max_element(simulated.begin(), simulated.end()));
  const std::string width = std::to_string(kWidth_px), height = std::to_string(kHeight_px);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + width + " " + height +
                    "\" class=\"chart\" role=\"img\" aria-label=\"Differences of ranges, " + bandName(band) + "\">\n";
  svg += "<path d=\"" + pathOf(real, largest) + "\" class=\"real\"/>\n";
  svg += "<path d=\"" + pathOf(simulated, largest) + "\" class=\"model\"/>\n";
  const int floor_px = kHeight_px - kMargin_px;
  svg += "<path d=\"M" + std::to_string(kMargin_px) + " " + std::to_string(floor_px) + " H" +
         std::to_string(kWidth_px - kMargin_px) + "\" class=\"axis\"/>\n";
  for (const int cm : {-15, -10, -5, 0, 5, 10, 15}) {
    const double x_px = kWidth_px / 2.0 + cm / 15.0 * (kWidth_px / 2.0 - kMargin_px);
    svg += "<text x=\"" + fixed(x_px, 0) + "\" y=\"" + std::to_string(floor_px + 16) +
           "\" font-size=\"11\" text-anchor=\"middle\">" + std::to_string(cm) + (cm == 15 ? " cm" : "") + "</text>\n";
  }
  svg += "<text x=\"" + std::to_string(kMargin_px) + "\" y=\"16\" font-size=\"11\">" + fixed(100 * largest, 0) +
         " % of the " + valuesOf(fit) + "</text>\n";
  return svg + "</svg>\n";
}

std::string describeExcluded(const ScannerFit& fit) {
  HtmlTable table({"scans", "time [s]", "turned at unchanged odometry [°]", "standard errors"}, false);
  bool has_any = false;
  for (const auto& pair : fit.candidates) {
    if (pair.is_at_rest || fit.criterion == RestCriterion::odometry) continue;
    has_any = true;
    table.add({std::to_string(pair.first) + " and " + std::to_string(pair.first + 1),
               fixed(fit.series.scans[pair.first].time_s, 2), fixed(toDegrees(pair.turned_rad), 3),
               fixed(std::abs(pair.turned_t), 1)});
  }
  return has_any ? table.html() : "<p>No pair at unchanged odometry was excluded.</p>\n";
}

std::string describeBands(const ScannerFit& fit) {
  std::string html;
  for (std::size_t band = 0; band < kBands; ++band) {
    const std::size_t n = fit.real.differences_m[band].size();
    html += "<h3>" + escapedHtml(bandName(band)) + "</h3>\n";
    if (n == 0) {
      html += "<p>No held-out " + valuesOf(fit) + ".</p>\n";
      continue;
    }
    const double ks = fit.computeKs(band), bound = fit.computeKsBound(band);
    const std::string parts = fit.basis == FitBasis::scans_at_rest ? " pairs" : " scans";
    html += "<p>KS distance " + fixed(ks, 3) + ", bound " + fixed(bound, 3) + " (" +
            (ks <= bound ? "agrees" : "differs") + "); " + withCommas(n) + " real and " +
            withCommas(fit.simulated.differences_m[band].size()) + " simulated " + valuesOf(fit) + ".";
    for (std::size_t half = 0; half < fit.folds.size(); ++half) {
      const HeldOutFit& fold = fit.folds[half];
      html += (half == 0 ? " Odd" : "; even") + parts +
              " alone: " + fixed(fit.computeKs(fold.real, fold.simulated, band), 3) + ", bound " +
              fixed(fold.computeKsBound(band), 3) +
              (fit.isBeyondBound(fold, band) ? " (<strong>differs</strong>)" : " (agrees)");
    }
    html += ".</p>\n";
    html += "<div class=charts tabindex=0>\n" + makeHistogram(fit, band) + "</div>\n";
  }
  return html;
}

}  // namespace

std::string reportHtml(const ScannerFit& fit, const std::string& rawlog) {
  std::string html = "<pre class=\"columns\" tabindex=\"0\">" + escapedHtml(summaryOf(fit)) + "</pre>\n";
  if (fit.basis == FitBasis::scans_at_rest) {
    html +=
        "<h2>Differences of scans at rest</h2>\n<p>Second minus first range of two successive scans. Filled: held-out "
        "pairs of the recording. Line: simulated by RoboSim's scanner with the fitted errors.</p>\n";
  } else {
    html +=
        "<h2>Residuals of the scans of a drive</h2>\n<p>Range minus that of the local map, which consists of the "
        "aligned scans before. <strong>The residuals also contain errors of the motion and of the map, so that the "
        "fitted errors are upper bounds of the scanner's own.</strong> Filled: held-out scans of the recording. Line: "
        "simulated by the errors of RoboSim's scanner that are fitted to the other scans.</p>\n";
  }
  html += describeBands(fit);
  html += "<h2>Excluded pairs</h2>\n" + describeExcluded(fit);
  html += "<h2>Model</h2>\n<pre class=\"columns\" tabindex=\"0\">" + escapedHtml(modelXml(fit, rawlog)) + "</pre>\n";
  return reportPage("Laser errors of " + rawlog, html, kHistogramStyle);
}

}  // namespace robosim
