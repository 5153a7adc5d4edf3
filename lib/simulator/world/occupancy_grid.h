#pragma once
#include <cstdint>
#include <vector>

#include <mrpt/math/TPose2D.h>

namespace robosim {

/// State of a cell.
enum class Occupancy : std::uint8_t { free, occupied, unknown };

/// Grid of square cells over a rectangle of the ground.
struct OccupancyGrid {
  std::uint32_t columns = 0, rows = 0;
  double cell_m = 0;                  ///< side of a cell, (0, kCellMax_m]
  mrpt::math::TPose2D map_from_grid;  ///< of the lower left corner of the first cell; x along the rows
  std::vector<Occupancy> cells;       ///< row by row from the bottom, each from the left
  std::uint64_t transparent = 0;      ///< number of cells that are unknown because their pixels are transparent

  Occupancy at(std::uint32_t column, std::uint32_t row) const { return cells[std::size_t{row} * columns + column]; }
};

/// @name Limits of a map
///@{
constexpr double kCellMax_m = 100;
constexpr std::uint64_t kMaxMapCells = 1u << 26;
constexpr std::size_t kMaxMapBoxes = 4'000'000;  ///< boxes that occupied cells are merged into; about 200 bytes each
constexpr double kMapReach_m = 1e7;              ///< of any coordinate: the maximum of geodetic grids
///@}

/// Thresholds of the probability of occupancy; the defaults are those of ROS's map_server.
struct OccupancyThresholds {
  double occupied = 0.65;      ///< occupied above this
  double free = 0.196;         ///< free below this; unknown between the two
  bool are_inclusive = false;  ///< whether the thresholds themselves are occupied and free, as in nav2

  Occupancy of(double probability) const {
    if (are_inclusive && probability >= occupied) return Occupancy::occupied;
    if (are_inclusive && probability <= free) return Occupancy::free;
    if (probability > occupied) return Occupancy::occupied;
    return probability < free ? Occupancy::free : Occupancy::unknown;
  }
  bool operator==(const OccupancyThresholds&) const = default;
};
/// Of Stage: pixels up to 127 are occupied, all others are free.
constexpr OccupancyThresholds kStageThresholds{.occupied = 0.5, .free = 0.5, .are_inclusive = false};

}  // namespace robosim
