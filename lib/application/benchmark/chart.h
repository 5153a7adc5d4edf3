#pragma once
#include <string>
#include <vector>

namespace robosim {

struct ChartPoint {
  double x = 0, y = 0;
};

/// A line of a chart.
struct ChartSeries {
  std::string name;
  std::vector<ChartPoint> points;  ///< in order of x
  bool is_step = false;            ///< constant from each point to the next
  bool is_reference = false;       ///< a bound or an ideal: dashed, in the colour of text
  /// Limits of a band around the line, at the points' x; empty: none.
  std::vector<double> low{}, high{};
};

/// A line chart with a legend on its right, which is as wide and high as the names of its series need.
struct Chart {
  std::string title;
  std::string x_label, y_label;
  double x_min = 0, x_max = 1;  ///< x_min < x_max; above 0 on a logarithmic axis
  double y_min = 0, y_max = 1;
  bool is_x_log2 = false;  ///< with a mark at each power of 2
  bool is_y_log2 = false;  ///< the same
  std::vector<ChartSeries> series;
};

/// Where the style of an SVG chart comes from.
enum class ChartColors {
  fixed,  ///< colours for white paper, in the element
  page,   ///< classes of the page: chartStyle()
};

/// An SVG element with text as text.
std::string svgOf(const Chart& chart, ChartColors colors);
/// The style of a page with charts, for light and dark; stated once, so that the charts are small.
std::string chartStyle();
/// A PDF document of one page; the same chart gives the same bytes.
std::string drawPdf(const Chart& chart);

/// Round numbers from at most `min` to at least `max`: at most `count` + 1, with steps of 1, 2 or 5 times a power
/// of 10.
std::vector<double> roundMarks(double min, double max, int count);

}  // namespace robosim
