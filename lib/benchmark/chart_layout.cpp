// Axes, lines and legend of a chart, for any canvas.
#include <algorithm>
#include <cmath>

#include "base/text_table.h"
#include "base/xml_element.h"
#include "benchmark/chart_canvas.h"

namespace robosim {
namespace {

constexpr double kLeft_px = 62, kRight_px = 200, kTop_px = 30, kBottom_px = 46;
constexpr double kText_px = 12, kTitle_px = 14;

/// From values to pixels.
class Axes {
 public:
  explicit Axes(const Chart& chart) : chart_(chart) {}
  double x(double value) const {
    const auto scale = [&](double v) { return chart_.is_x_log2 ? std::log2(v) : v; };
    const double share = (scale(value) - scale(chart_.x_min)) / (scale(chart_.x_max) - scale(chart_.x_min));
    return kLeft_px + std::clamp(share, 0.0, 1.0) * (kChartWidth_px - kLeft_px - kRight_px);
  }
  double y(double value) const {
    const double share = (value - chart_.y_min) / (chart_.y_max - chart_.y_min);
    return kChartHeight_px - kBottom_px - std::clamp(share, 0.0, 1.0) * (kChartHeight_px - kTop_px - kBottom_px);
  }
  ChartPoint at(double px, double py) const { return {x(px), y(py)}; }

 private:
  const Chart& chart_;
};

std::vector<ChartPoint> linePoints(const ChartSeries& series, const Axes& axes) {
  std::vector<ChartPoint> line;
  for (const auto& point : series.points) {
    const ChartPoint at = axes.at(point.x, point.y);
    if (series.is_step && !line.empty()) line.push_back({at.x, line.back().y});
    line.push_back(at);
  }
  return line;
}

std::vector<ChartPoint> bandPoints(const ChartSeries& series, const Axes& axes) {
  std::vector<ChartPoint> forth, back;
  const auto add = [&](std::vector<ChartPoint>& side, const std::vector<double>& limits, std::size_t i) {
    const ChartPoint at = axes.at(series.points[i].x, limits[i]);
    if (series.is_step && !side.empty()) side.push_back({at.x, side.back().y});
    side.push_back(at);
  };
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    add(forth, series.high, i);
    add(back, series.low, i);
  }
  forth.insert(forth.end(), back.rbegin(), back.rend());
  return forth;
}

void drawAxes(const Chart& chart, const Axes& axes, ChartCanvas& canvas) {
  std::vector<double> marks;
  if (chart.is_x_log2) {
    for (double mark = 1; mark <= chart.x_max; mark *= 2) {
      if (mark >= chart.x_min) marks.push_back(mark);
    }
  } else {
    marks = roundMarks(chart.x_min, chart.x_max, 8);
  }
  const double floor_px = axes.y(chart.y_min);
  for (const double mark : marks) {
    if (mark > chart.x_max) continue;
    const double x_px = axes.x(mark);
    canvas.line({{x_px, floor_px}, {x_px, kTop_px}}, {ChartInk::kGrid}, 1, false);
    canvas.text({x_px, floor_px + 17}, toText(mark), ChartAnchor::middle, kText_px);
  }
  for (const double mark : roundMarks(chart.y_min, chart.y_max, 5)) {
    if (mark > chart.y_max) continue;
    const double y_px = axes.y(mark);
    canvas.line({{kLeft_px, y_px}, {kChartWidth_px - kRight_px, y_px}}, {ChartInk::kGrid}, 1, false);
    canvas.text({kLeft_px - 8, y_px + 4}, toText(mark), ChartAnchor::end, kText_px);
  }
  canvas.line({{kLeft_px, kTop_px}, {kLeft_px, floor_px}, {kChartWidth_px - kRight_px, floor_px}}, {ChartInk::kText}, 1,
              false);
  canvas.text({kLeft_px, 18}, chart.title, ChartAnchor::start, kTitle_px);
  canvas.text({(kLeft_px + kChartWidth_px - kRight_px) / 2, kChartHeight_px - 8}, chart.x_label, ChartAnchor::middle,
              kText_px);
  canvas.text({16, (kTop_px + floor_px) / 2}, chart.y_label, ChartAnchor::middle, kText_px, true);
}

}  // namespace

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
  const Axes axes(chart);
  drawAxes(chart, axes, canvas);
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const ChartSeries& series = chart.series[i];
    const ChartInk ink{static_cast<int>(i % kSeriesColors)};
    if (!series.low.empty()) canvas.area(bandPoints(series, axes), ink);
  }
  double legend_y_px = kTop_px + 8;
  const double legend_x_px = kChartWidth_px - kRight_px + 14;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const ChartSeries& series = chart.series[i];
    const ChartInk ink{static_cast<int>(i % kSeriesColors)};
    const bool is_dashed = series.is_dashed || i >= kSeriesColors;
    canvas.line(linePoints(series, axes), ink, 1.8, is_dashed);
    canvas.line({{legend_x_px, legend_y_px}, {legend_x_px + 22, legend_y_px}}, ink, 2.5, is_dashed);
    canvas.text({legend_x_px + 28, legend_y_px + 4}, series.name, ChartAnchor::start, kText_px);
    legend_y_px += 19;
  }
}

}  // namespace robosim
