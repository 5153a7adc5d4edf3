#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rendering/drawn_run.h"
#include "rendering/figure.h"
#include "rendering/ground_painter.h"
#include "robots/fleet.h"

namespace robosim {

/// @name Widths of marks [px]
///@{
inline constexpr double kStartMark_px = 9, kEndMark_px = 16, kEventMark_px = 14, kSensorMark_px = 20;
///@}

/// Paints the world and the robots of a run on a figure, in the layers of the functions, from back to front. Many
/// robots are painted in less detail (DetailLevel); the run then is a reduced() one.
class RunPainter {
 public:
  struct Style {
    double text_px = kTextSize_px;           ///< height of a capital in names
    double path_px = 2.4;                    ///< width of paths
    std::optional<Bounds2D> names_within{};  ///< rectangle of pixels; nullopt: the picture
  };
  /// @param figure, world, fleet, run must outlive this
  RunPainter(Figure& figure, const World& world, const Fleet& fleet, const DrawnRun& run, const Style& style);

  /// Floor, density map, areas measured as free, paths with a ring at each start, echoes, maps and objects.
  void paintGround();
  /// Robots at their final poses, with small marks of events of many robots below them.
  void paintRobots();
  /// Marks of the events; of several of one robot and kind within a mark's size only the first. A mark on a robot is
  /// moved beside it, where there is least on the picture.
  void paintEvents();
  /// Names of hot objects and robots, where there is room.
  void paintNames();

  /// @name Marks, also of a legend; centre in pixels
  ///@{
  void paintStart(const mrpt::math::TPoint2D& at, const Color&);
  void paintEnd(const mrpt::math::TPoint2D& at, const Color&);
  void paintEvent(RunEvent::Kind, const mrpt::math::TPoint2D& at, const Color&);
  void paintSensor(SensorKind, const mrpt::math::TPoint2D& at);
  void paintDensityScale(const mrpt::math::TPoint2D& at);
  ///@}

 private:
  mrpt::math::TPoint2D besideRobots(const mrpt::math::TPoint2D& at) const;
  std::optional<mrpt::math::TPoint2D> robotPixel(std::size_t robot) const;
  double robotRadius(std::size_t robot) const;  ///< [px]
  void paintSmallEvent(RunEvent::Kind, const mrpt::math::TPoint2D& at, const Color&);
  void paintCross(const mrpt::math::TPoint2D& at, double half_px, double width_px, const Color&);
  std::vector<std::size_t> fromOutside() const;
  float pathPaleness() const;
  void paintFreeAreas();
  void paintEchoes();
  void paintSightLines();
  void paintPath(std::size_t robot, float paleness);
  void paintTrails(float newest);
  void paintSmallEvents();
  template <typename Paint>
  void forEachEvent(const Paint& paint) const;
  std::vector<mrpt::math::TPoint2D> toPixels(std::span<const mrpt::math::TPoint2D> places) const;

  Figure& figure_;
  const GroundView& view_;
  const World& world_;
  const Fleet& fleet_;
  const DrawnRun& run_;
  Style style_;
  DetailLevel level_;
  std::vector<Color> colors_;                ///< by robot
  std::vector<mrpt::math::TPoint2D> marks_;  ///< of the painted events [px]
};

}  // namespace robosim
