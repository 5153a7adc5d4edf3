#pragma once
#include <optional>
#include <string>
#include <vector>

#include "rendering/drawn_run.h"
#include "rendering/figure.h"
#include "rendering/ground_painter.h"
#include "robots/fleet.h"

namespace robosim {

/// Paints the world and the robots of a run on a figure, in the layers of the functions, from back to front.
class RunPainter {
 public:
  struct Style {
    double text_px = kTextSize_px;  ///< height of a capital letter in names
    double path_px = 2.4;           ///< width of paths
  };
  /// @param figure, world, fleet, run must outlive this
  RunPainter(Figure& figure, const World& world, const Fleet& fleet, const DrawnRun& run, const Style& style);

  /// Floor, paths with a ring at each start, maps and objects.
  void paintGround();
  /// Robots at their final poses.
  void paintRobots();
  /// Marks of the events; of several of one robot and kind within a mark's size only the first. A mark on a robot is
  /// moved beside it, where there is least on the picture.
  void paintEvents();
  /// Names of hot objects and robots, where there is room.
  void paintNames();

  /// @name Marks, also of a legend; centre in pixels
  ///@{
  void paintStart(const mrpt::math::TPoint2D& at, const Color&);
  void paintEvent(RunEvent::Kind, const mrpt::math::TPoint2D& at, const Color&);
  ///@}

 private:
  mrpt::math::TPoint2D besideRobots(const mrpt::math::TPoint2D& at) const;
  std::optional<mrpt::math::TPoint2D> robotPixel(std::size_t robot) const;
  double robotRadius(std::size_t robot) const;  ///< [px]
  float pathPaleness() const;
  void paintPath(std::size_t robot, float paleness);

  Figure& figure_;
  const GroundView& view_;
  const World& world_;
  const Fleet& fleet_;
  const DrawnRun& run_;
  Style style_;
  std::vector<Color> colors_;                ///< by robot
  std::vector<mrpt::math::TPoint2D> marks_;  ///< of the painted events [px]
};

/// A legend in one line.
class Legend {
 public:
  /// @param right, y its right end and middle [px]
  Legend(Figure& figure, double right, double y, double text_px = kTextSize_px)
      : figure_(figure), x_(right), y_(y), text_px_(text_px) {}

  /// Adds an entry to the left of the previous one; draw(TPoint2D) draws its mark.
  template <typename Draw>
  void add(const std::string& word, double mark_width_px, const Draw& draw) {
    x_ -= figure_.textWidth(word, text_px_);
    figure_.text({x_, y_}, word, text_px_, kInkColor);
    x_ -= 6 + mark_width_px / 2;
    draw(mrpt::math::TPoint2D(x_, y_));
    x_ -= mark_width_px / 2 + 18;
  }

 private:
  Figure& figure_;
  double x_, y_, text_px_;
};

/// Entries for starts and ends of paths.
void paintPathLegend(Legend&, RunPainter&, Figure&);

}  // namespace robosim
