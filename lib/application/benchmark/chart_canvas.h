#pragma once
#include <array>
#include <string>
#include <vector>

#include "benchmark/chart.h"

namespace robosim {

/// A colour of charts: text and axes, grid, or that of a series by number.
struct ChartInk {
  static constexpr int kText = -1, kGrid = -2;
  int index = kText;
};

/// Number of colours of series; further series repeat them, dashed.
inline constexpr int kSeriesColors = 10;

/// Red, green, blue of an ink on white paper or on a dark page, [0, 255]. The series' colours have a contrast of at
/// least 3:1 to the background, and were chosen for the largest difference between any two, with and without
/// red-green colour blindness.
std::array<int, 3> paperColor(ChartInk ink);
std::array<int, 3> darkColor(ChartInk ink);

enum class ChartAnchor { start, middle, end };

enum class ChartPen {
  thin,  ///< axes and grid
  line,  ///< of a series
  edge,  ///< of a band, half transparent
};

using ChartLine = std::vector<ChartPoint>;

/// What a chart is drawn on, in pixels of 1/96 inch from the upper left.
class ChartCanvas {
 public:
  virtual ~ChartCanvas() = default;
  virtual void lines(const std::vector<ChartLine>& lines, ChartInk ink, ChartPen pen, bool is_dashed) = 0;
  /// A closed polygon, filled with a fifth of the ink's opacity.
  virtual void area(const ChartLine& points, ChartInk ink) = 0;
  /// @param at end of the baseline, by the anchor
  virtual void text(const ChartPoint& at, const std::string& text, ChartAnchor anchor, double size_px,
                    bool is_upward = false) = 0;
};

inline constexpr double kChartText_px = 12;

struct ChartSize {
  double width_px = 0, height_px = 0;
};

/// 680 × 320 px; more if the legend needs it.
ChartSize sizeOf(const Chart& chart);
void draw(const Chart& chart, ChartCanvas& canvas);

/// Widths of the pens [px].
double widthOf(ChartPen pen);

}  // namespace robosim
