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

/// Red, green, blue of an ink on white paper, [0, 255]. The series have the palette of Okabe & Ito (2008, "Color
/// universal design"), which people with colour blindness can tell apart.
std::array<int, 3> paperColor(ChartInk ink);
/// Number of colours of series; further series repeat them, dashed.
inline constexpr int kSeriesColors = 8;

enum class ChartAnchor { start, middle, end };

/// What a chart is drawn on, in pixels of 1/96 inch from the upper left.
class ChartCanvas {
 public:
  virtual ~ChartCanvas() = default;
  virtual void line(const std::vector<ChartPoint>& points, ChartInk ink, double width_px, bool is_dashed) = 0;
  /// A closed polygon, filled with a fifth of the ink's opacity.
  virtual void area(const std::vector<ChartPoint>& points, ChartInk ink) = 0;
  /// @param at end of the baseline, by the anchor
  virtual void text(const ChartPoint& at, const std::string& text, ChartAnchor anchor, double size_px,
                    bool is_upward = false) = 0;
};

inline constexpr double kChartWidth_px = 680, kChartHeight_px = 320;

void draw(const Chart& chart, ChartCanvas& canvas);

}  // namespace robosim
