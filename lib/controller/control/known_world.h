#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include <mrpt/math/TPoint2D.h>

namespace robosim {

/// Map of a world for a controller that is given it, such as a plan of a building: an occupancy grid of all stationary
/// obstacles, and the heat sources. World frame. Cells are numbered row by row from the lower left corner.
struct KnownWorld {
  struct HeatSource {
    mrpt::math::TPoint2D place;  ///< [m]
    double heat_celsius = 0;     ///< at its centre, > 0
  };

  mrpt::math::TPoint2D low;  ///< lower left corner [m]
  double cell_m = 0;         ///< side of a cell, > 0
  std::size_t columns = 0, rows = 0;
  std::vector<std::uint8_t> occupied;  ///< by cell: whether an obstacle is within half a cell of its centre
  std::vector<HeatSource> sources;

  mrpt::math::TPoint2D center(std::size_t cell) const {
    return {low.x + (static_cast<double>(cell % columns) + 0.5) * cell_m,
            low.y + (static_cast<double>(cell / columns) + 0.5) * cell_m};
  }
};

}  // namespace robosim
