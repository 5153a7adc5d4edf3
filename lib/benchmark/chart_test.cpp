#include "benchmark/chart.h"

#include <gtest/gtest.h>

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

TEST(Chart, DrawsStepsAsCorners) {
  // x: 0 to 10 from 62 to 480 px; y: 0 to 1 from 274 to 30 px.
  const std::string svg = svgOf(someChart(), ChartColors::fixed);
  EXPECT_NE(svg.find("<polyline points=\"62.0,30.0 271.0,30.0 271.0,152.0\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("<polyline points=\"62.0,274.0 480.0,30.0\""), std::string::npos) << svg;
  // The band: the upper limit forth, the lower limit back.
  EXPECT_NE(svg.find("<polygon points=\"62.0,30.0 271.0,30.0 271.0,91.0 271.0,213.0 271.0,30.0 62.0,30.0\""),
            std::string::npos)
      << svg;
}

TEST(Chart, EscapesTexts) {
  const std::string svg = svgOf(someChart(), ChartColors::page);
  EXPECT_NE(svg.find("maze &lt;1&gt; &amp; more"), std::string::npos);
  EXPECT_NE(svg.find("style=\"stroke:var(--chart-0)\""), std::string::npos);
  EXPECT_NE(chartStyle().find("--chart-0:#"), std::string::npos);
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
  EXPECT_NE(svg.find("translate(271.0 291.0)"), std::string::npos) << "4 is half way: " << svg;
}

TEST(Chart, IsAPdfDocumentWithTheSameBytesEachTime) {
  const std::string pdf = pdfOf(someChart());
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_EQ(pdfOf(someChart()), pdf);
}

}  // namespace
}  // namespace robosim
