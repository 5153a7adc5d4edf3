#pragma once
#include <optional>
#include <string>

#include "world/occupancy_grid.h"
#include "world/world.h"

/// A world as an occupancy grid, for export as a map. Maps contain all stationary solids, but no robots.
namespace robosim {

/// Region and resolution of an exported map.
struct MapExtent {
  double cell_m = 0.05;  ///< side of a cell or voxel, (0, kCellMax_m]
  HeightSpan heights;    ///< solids considered by a grid; vertical extent of an OctoMap
  /// Origin [m] of the grid's cells, which lie at multiples of cell_m from it; an OctoMap's voxels always start at (0,
  /// 0).
  mrpt::math::TPoint2D origin{0, 0};
};

/// Heights occupied by the robots of a world; 0 to 1 m if there are none.
HeightSpan robotHeights(const std::vector<HeightSpan>& robots);
/// Heights from the ground, or the lowest underside, to the highest top of all stationary solids; 0 to 1 m if there are
/// none.
HeightSpan heightsOfAll(const World&);

/// Cell size and origin of the first map that has cells and is not rotated; nullopt if there is none.
std::optional<MapExtent> extentOfMap(const World&);

/// Occupancy grid of the world, covering the surface and all stationary solids. A cell is occupied if a solid within
/// the heights overlaps it, however little. Other cells on the surface are free, except those that are unknown in a
/// map. All remaining cells are unknown.
/// @throws ConfigError for more than kMaxMapCells cells
OccupancyGrid rasterize(const World&, const MapExtent&);

}  // namespace robosim
