#pragma once
#include <functional>
#include <string>
#include <vector>

#include "rendering/drawn_run.h"
#include "rendering/run_painter.h"

namespace robosim {

/// A mark of a figure, and its meaning.
struct LegendEntry {
  std::string word;
  double mark_px;  ///< width
  std::function<void(RunPainter&, const mrpt::math::TPoint2D& center)> paint_mark;

  static LegendEntry ofStart();
  static LegendEntry ofEnd();
  static LegendEntry ofDensity(const DensityMap&);
};

/// Entries for what a run contains: density, ranges of sensors, starts and ends of paths, events.
std::vector<LegendEntry> makeLegend(const DrawnRun&);

/// A legend, in as many lines as its width requires.
class Legend {
 public:
  /// @param width_of returns the width of a word
  Legend(std::vector<LegendEntry> entries, double text_px, double width_px,
         const std::function<double(const std::string& word)>& width_of);

  std::size_t lines() const { return lines_.size(); }
  double linePitch() const { return 2.2 * text_px_; }  ///< [px]
  /// Paints all lines, which end at `right`.
  /// @param y middle of the first line [px]
  void paint(Figure& figure, RunPainter& painter, double right, double y) const;

 private:
  struct Placed {
    LegendEntry entry;
    double mark_center, word_left;  ///< [px], from the left end of the line
  };
  struct Line {
    std::vector<Placed> entries;
    double width_px = 0;
  };

  double text_px_;
  std::vector<Line> lines_;
};

}  // namespace robosim
