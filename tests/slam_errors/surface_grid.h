#pragma once
#include <cstdint>
#include <vector>

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/math/TPose2D.h>

#include "calibration/standing_scans.h"
#include "geometry/shapes/solid.h"

namespace robosim {

/// Surfaces that the scans of a drive show, on a grid. A cell is occupied if a sufficient share of the beams that reach
/// it end in it (counting model: D. Hähnel, R. Triebel, W. Burgard, S. Thrun, "Map building with mobile robots in
/// dynamic environments", ICRA 2003).
class SurfaceGrid {
 public:
  static constexpr double kCell_m = 0.05;

  /// @param start_from_robot pose of the robot at each scan
  SurfaceGrid(const ScanSeries& series, const std::vector<mrpt::math::TPose2D>& start_from_robot);

  /// A thin box of 2 m height for each occupied cell, along the mean of its surfaces; none within `clear_m` of the
  /// path.
  std::vector<Solid> solids(const std::vector<mrpt::math::TPose2D>& path, double clear_m) const;
  mrpt::maps::COccupancyGridMap2D gridmap() const;

 private:
  struct Cell {
    std::uint16_t ends = 0, passes = 0;
    float x_m = 0, y_m = 0;      ///< sum of the points of surfaces, from the middle of the cell
    float cos_2 = 0, sin_2 = 0;  ///< sum of their directions, of twice the angle
  };
  struct Index {
    int x = 0, y = 0;
  };

  Index indexOf(const mrpt::math::TPoint2D& p) const;
  Cell* cellAt(const Index& index);
  bool isOccupied(const Cell& cell) const;
  mrpt::math::TPoint2D centerOf(const Cell& cell) const;
  void addPoint(Cell& cell, const mrpt::math::TPoint2D& p);
  void addSurface(Cell& cell, const mrpt::math::TPoint2D& from, const mrpt::math::TPoint2D& to);
  Solid solidOf(const Cell& cell) const;
  template <typename Visit>
  void traverse(const mrpt::math::TPoint2D& from, const mrpt::math::TPoint2D& to, const Visit& visit);

  int half_;  ///< cells from the origin to each side
  std::vector<Cell> cells_;
};

}  // namespace robosim
