#pragma once
#include <string>
#include <vector>

#include "benchmark/chart.h"
#include "benchmark/chart_canvas.h"

namespace robosim {

/// The names of a chart's series, each beside a piece of its line, in one or several lines.
class ChartLegend {
 public:
  explicit ChartLegend(const Chart& chart);

  /// Independent of the fonts of the machine: an upper bound of the widths of usual sans-serif fonts.
  double width() const { return width_px_; }
  double height() const { return height_px_; }
  /// @param at its upper left
  void drawNames(ChartPoint at, ChartCanvas& canvas) const;
  /// The piece of the line of a series. @param at upper left of the legend
  ChartLine keyOf(std::size_t series, ChartPoint at) const;

 private:
  std::vector<std::vector<std::string>> names_;  ///< by series and line
  double width_px_ = 0, height_px_ = 0;
};

/// The words of a text in lines of at most `length` characters, unless a word is longer.
std::vector<std::string> wrapped(const std::string& text, std::size_t length);

}  // namespace robosim
