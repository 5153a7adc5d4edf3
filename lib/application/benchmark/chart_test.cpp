#include "benchmark/chart.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "benchmark/chart_canvas.h"

namespace robosim {
namespace {

Chart someChart() {
  Chart chart;
  chart.title = "maze <1> & more";
  chart.x_label = "time [s]";
  chart.y_label = "share";
  chart.x_max = 10;
  ChartSeries steps, line;
  steps.name = "a";
  steps.points = {{0, 1}, {5, 0.5}};
  steps.is_step = true;
  steps.low = {1, 0.25};
  steps.high = {1, 0.75};
  line.name = "b";
  line.points = {{0, 0}, {10, 1}};
  chart.series = {steps, line};
  return chart;
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Chart, DrawsStepsAsCorners) {
  // x: 0 to 10 from 62 to 480 px; y: 0 to 1 from 274 to 30 px. Behind the 22 px of the legend follows the line: half
  // way to the right at 1, and down to 0.5.
  const std::string svg = svgOf(someChart(), ChartColors::fixed);
  EXPECT_NE(svg.find("d=\"M494 38h22M62 30h209v122\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("d=\"M494 57h22M62 274l418-244\""), std::string::npos) << svg;
  // The band: the upper limit forth, the lower limit back.
  EXPECT_NE(svg.find("d=\"M62 30h209v61v122v-183h-209z\""), std::string::npos) << svg;
}

TEST(Chart, DrawsTheEdgesOfManyBandsInsteadOfAreas) {
  Chart chart = someChart();
  const ChartSeries steps = chart.series.front();
  chart.series.assign(4, steps);
  EXPECT_EQ(occurrences(svgOf(chart, ChartColors::page), "class=\"area a"), 4u);
  EXPECT_EQ(occurrences(svgOf(chart, ChartColors::page), "edge\" d="), 0u);
  chart.series.assign(5, steps);
  const std::string svg = svgOf(chart, ChartColors::page);
  EXPECT_EQ(occurrences(svg, "class=\"area a"), 0u);
  EXPECT_EQ(occurrences(svg, "class=\"c0 edge\" d=\"M62 30h209v61M62 30h209v183\""), 1u) << svg;
  EXPECT_EQ(occurrences(svg, "edge\" d="), 5u);
}

TEST(Chart, EscapesTexts) {
  const std::string svg = svgOf(someChart(), ChartColors::page);
  EXPECT_NE(svg.find("maze &lt;1&gt; &amp; more"), std::string::npos);
  EXPECT_NE(svg.find("<path class=c0 d="), std::string::npos) << svg;
  EXPECT_NE(chartStyle().find(".c0{stroke:var(--c0)}"), std::string::npos);
}

/// WCAG 2.2's ratio.
double contrast(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  const auto luminance = [](const std::array<int, 3>& color) {
    const auto linear = [](int part) {
      const double share = part / 255.0;
      return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(color[0]) + 0.7152 * linear(color[1]) + 0.0722 * linear(color[2]);
  };
  const double x = luminance(a) + 0.05, y = luminance(b) + 0.05;
  return std::max(x, y) / std::min(x, y);
}

TEST(Chart, HasTenDifferentColoursThatAreLegibleInLightAndDark) {
  ASSERT_EQ(kSeriesColors, 10);
  std::set<std::array<int, 3>> paper, dark;
  for (int i = 0; i < kSeriesColors; ++i) {
    paper.insert(paperColor({i}));
    dark.insert(darkColor({i}));
    EXPECT_GE(contrast(paperColor({i}), {255, 255, 255}), 3) << i;
    EXPECT_GE(contrast(darkColor({i}), {21, 24, 28}), 3) << i;
  }
  EXPECT_EQ(paper.size(), 10u);
  EXPECT_EQ(dark.size(), 10u);
}

TEST(Chart, DrawsReferencesInTheColourOfText) {
  Chart chart = someChart();
  chart.series.resize(1);
  chart.series.push_back({.name = "linear", .points = {{0, 0}, {10, 1}}, .is_reference = true});
  EXPECT_NE(svgOf(chart, ChartColors::page).find("class=\"ct dash\" d=\"M494 57h22M62 274l418-244\""),
            std::string::npos);
}

TEST(Chart, HasALegendAsWideAsItsLongestLine) {
  Chart chart = someChart();
  EXPECT_EQ(sizeOf(chart).width_px, 680);
  EXPECT_EQ(sizeOf(chart).height_px, 320);
  // 23 characters in 28 + 23 · 7.8 px, 207.4, which are 30 more than there were.
  chart.series[0].name = "stigmergy evaporation=1";
  EXPECT_EQ(sizeOf(chart).width_px, 680 + 30);
  // Two lines of 22 and 8 characters instead of one of 31; further names are lower by 15 px.
  chart.series[0].name = "levy_walk exponent=1.5 max_m=20";
  EXPECT_EQ(sizeOf(chart).width_px, 680 + 22);
  const std::string svg = svgOf(chart, ChartColors::fixed);
  EXPECT_NE(svg.find("<text x=\"522\" y=\"42\">levy_walk exponent=1.5</text>"), std::string::npos) << svg;
  EXPECT_NE(svg.find("<text x=\"522\" y=\"57\">max_m=20</text>"), std::string::npos);
  EXPECT_NE(svg.find("<text x=\"522\" y=\"76\">b</text>"), std::string::npos);
}

TEST(Chart, IsAsHighAsALongLegend) {
  Chart chart = someChart();
  chart.series.assign(20, chart.series.front());
  EXPECT_EQ(sizeOf(chart).height_px, 30 + 20 * 19);
}

TEST(Chart, HasRoundMarks) {
  EXPECT_EQ(roundMarks(0, 1, 5), (std::vector<double>{0, 0.2, 0.4, 0.6, 0.8, 1}));
  EXPECT_EQ(roundMarks(0, 1800, 8), (std::vector<double>{0, 500, 1000, 1500, 2000}));
  EXPECT_EQ(roundMarks(0, 7.3, 5), (std::vector<double>{0, 2, 4, 6, 8}));
  EXPECT_EQ(roundMarks(0, 0.03, 3), (std::vector<double>{0, 0.01, 0.02, 0.03}));
}

TEST(Chart, MarksPowersOfTwoOnALogarithmicAxis) {
  Chart chart = someChart();
  chart.is_x_log2 = true;
  chart.x_min = 1;
  chart.x_max = 16;
  const std::string svg = svgOf(chart, ChartColors::fixed);
  for (const std::string mark : {">1<", ">2<", ">4<", ">8<", ">16<"}) EXPECT_NE(svg.find(mark), std::string::npos);
  EXPECT_NE(svg.find("<text x=\"271\" y=\"291\" text-anchor=\"middle\">4<"), std::string::npos)
      << "4 is half way: " << svg;
}

TEST(Chart, MarksPowersOfTwoOnBothLogarithmicAxes) {
  Chart chart = someChart();
  chart.is_x_log2 = chart.is_y_log2 = true;
  chart.x_min = 1;
  chart.x_max = 16;
  chart.y_min = 0.5;
  chart.y_max = 8;
  chart.series.resize(1);
  chart.series.front() = {.name = "linear", .points = {{1, 1}, {8, 8}}};
  const std::string svg = svgOf(chart, ChartColors::fixed);
  // 1 is a quarter of the height above 0.5: 274 - 61 px. From 1 to 8: three quarters of either axis.
  EXPECT_NE(svg.find("M62 213l313.5-183\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("y=\"278\" text-anchor=\"end\">0.5<"), std::string::npos) << svg;
  EXPECT_NE(svg.find("y=\"217\" text-anchor=\"end\">1<"), std::string::npos) << svg;
}

TEST(Chart, IsAPdfDocumentWithTheSameBytesEachTime) {
  const std::string pdf = drawPdf(someChart());
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_EQ(drawPdf(someChart()), pdf);
}

}  // namespace
}  // namespace robosim
