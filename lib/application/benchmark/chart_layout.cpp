// Axes, lines and legend of a chart, for any canvas.
#include <algorithm>
#include <cmath>

#include "base/text_table.h"
#include "base/xml_element.h"
#include "benchmark/chart_canvas.h"
#include "benchmark/chart_legend.h"

namespace robosim {
namespace {

constexpr double kLeft_px = 62, kPlotWidth_px = 418, kTop_px = 30, kPlotHeight_px = 244, kBottom_px = 46;
constexpr double kLegendGap_px = 14, kLegendMargin_px = 8, kLegendWidthMin_px = 178;
constexpr double kTitle_px = 14;
constexpr double kPlotRight_px = kLeft_px + kPlotWidth_px;
/// More bands than these are drawn as their edges, because overlapping areas hide each other.
constexpr std::size_t kFilledBands = 4;

/// From values to pixels.
class Axes {
 public:
  Axes(const Chart& chart, double floor_px) : chart_(chart), floor_px_(floor_px) {}
  double floor() const { return floor_px_; }
  double x(double value) const {
    return kLeft_px + share(value, chart_.x_min, chart_.x_max, chart_.is_x_log2) * kPlotWidth_px;
  }
  double y(double value) const {
    return floor_px_ - share(value, chart_.y_min, chart_.y_max, chart_.is_y_log2) * (floor_px_ - kTop_px);
  }
  ChartPoint at(double px, double py) const { return {x(px), y(py)}; }

 private:
  static double share(double value, double min, double max, bool is_log2) {
    const auto scale = [&](double v) { return is_log2 ? std::log2(v) : v; };
    return std::clamp((scale(value) - scale(min)) / (scale(max) - scale(min)), 0.0, 1.0);
  }
  const Chart& chart_;
  double floor_px_;
};

void addPoint(ChartLine& line, const ChartPoint& at, bool is_step) {
  if (is_step && !line.empty()) line.push_back({at.x, line.back().y});
  line.push_back(at);
}

ChartLine linePoints(const ChartSeries& series, const Axes& axes) {
  ChartLine line;
  for (const auto& point : series.points) addPoint(line, axes.at(point.x, point.y), series.is_step);
  return line;
}

ChartLine edgePoints(const ChartSeries& series, const std::vector<double>& limits, const Axes& axes) {
  ChartLine line;
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    addPoint(line, axes.at(series.points[i].x, limits[i]), series.is_step);
  }
  return line;
}

void drawBand(const ChartSeries& series, const Axes& axes, ChartInk ink, bool is_filled, ChartCanvas& canvas) {
  ChartLine high = edgePoints(series, series.high, axes);
  const ChartLine low = edgePoints(series, series.low, axes);
  if (is_filled) {
    high.insert(high.end(), low.rbegin(), low.rend());
    canvas.area(high, ink);
  } else {
    canvas.lines({high, low}, ink, ChartPen::edge, false);
  }
}

std::vector<double> computeMarks(double min, double max, bool is_log2, int count) {
  std::vector<double> marks;
  if (!is_log2) {
    marks = roundMarks(min, max, count);
    std::erase_if(marks, [&](double mark) { return mark > max; });
    return marks;
  }
  for (double mark = std::exp2(std::ceil(std::log2(min) - 1e-9)); mark <= max; mark *= 2) marks.push_back(mark);
  return marks;
}

void drawAxes(const Chart& chart, const Axes& axes, ChartCanvas& canvas) {
  std::vector<ChartLine> grid;
  const double floor_px = axes.floor();
  for (const double mark : computeMarks(chart.x_min, chart.x_max, chart.is_x_log2, 8)) {
    const double x_px = axes.x(mark);
    grid.push_back({{x_px, floor_px}, {x_px, kTop_px}});
    canvas.text({x_px, floor_px + 17}, toText(mark), ChartAnchor::middle, kChartText_px);
  }
  for (const double mark : computeMarks(chart.y_min, chart.y_max, chart.is_y_log2, 5)) {
    const double y_px = axes.y(mark);
    grid.push_back({{kLeft_px, y_px}, {kPlotRight_px, y_px}});
    canvas.text({kLeft_px - 8, y_px + 4}, toText(mark), ChartAnchor::end, kChartText_px);
  }
  canvas.lines(grid, {ChartInk::kGrid}, ChartPen::thin, false);
  canvas.lines({{{kLeft_px, kTop_px}, {kLeft_px, floor_px}, {kPlotRight_px, floor_px}}}, {ChartInk::kText},
               ChartPen::thin, false);
  canvas.text({kLeft_px, 18}, chart.title, ChartAnchor::start, kTitle_px);
  canvas.text({(kLeft_px + kPlotRight_px) / 2, floor_px + 38}, chart.x_label, ChartAnchor::middle, kChartText_px);
  canvas.text({16, (kTop_px + floor_px) / 2}, chart.y_label, ChartAnchor::middle, kChartText_px, true);
}

}  // namespace

double widthOf(ChartPen pen) {
  constexpr double kWidths_px[] = {1, 1.8, 0.7};
  return kWidths_px[static_cast<int>(pen)];
}

ChartSize sizeOf(const Chart& chart) {
  const ChartLegend legend(chart);
  return {kPlotRight_px + kLegendGap_px + std::ceil(std::max(kLegendWidthMin_px, legend.width())) + kLegendMargin_px,
          kTop_px + std::max(kPlotHeight_px + kBottom_px, legend.height())};
}

std::vector<double> roundMarks(double min, double max, int count) {
  const double wanted = (max - min) / count;
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= wanted * (1 - 1e-9)) step = factor * power;
  }
  std::vector<double> marks;
  const auto first = static_cast<long>(std::floor(min / step + 1e-9));
  for (long i = first; marks.empty() || marks.back() < max - 1e-9 * step; ++i) {
    // Multiplied by whole numbers, so that 3 · 0.1 is printed as 0.3.
    marks.push_back(step >= 1 ? static_cast<double>(i) * step : static_cast<double>(i) / std::round(1 / step));
  }
  return marks;
}

void draw(const Chart& chart, ChartCanvas& canvas) {
  const ChartLegend legend(chart);
  const ChartPoint legend_at{kPlotRight_px + kLegendGap_px, kTop_px};
  const Axes axes(chart, sizeOf(chart).height_px - kBottom_px);
  drawAxes(chart, axes, canvas);
  const auto bands = std::count_if(chart.series.begin(), chart.series.end(),
                                   [](const ChartSeries& series) { return !series.low.empty(); });
  const auto inkOf = [&](std::size_t i) {
    return ChartInk{chart.series[i].is_reference ? ChartInk::kText : static_cast<int>(i % kSeriesColors)};
  };
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    if (chart.series[i].low.empty()) continue;
    drawBand(chart.series[i], axes, inkOf(i), static_cast<std::size_t>(bands) <= kFilledBands, canvas);
  }
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const ChartSeries& series = chart.series[i];
    const bool is_dashed = series.is_reference || i >= kSeriesColors;
    canvas.lines({legend.keyOf(i, legend_at), linePoints(series, axes)}, inkOf(i), ChartPen::line, is_dashed);
  }
  legend.drawNames(legend_at, canvas);
}

}  // namespace robosim
