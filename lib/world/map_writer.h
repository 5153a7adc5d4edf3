#pragma once
#include <functional>
#include <optional>
#include <string>

#include "world/occupancy_grid.h"
#include "world/world.h"

/// Exports a world as a map in formats of other programs. Maps contain all stationary solids, but no robots.
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
OccupancyGrid rasterOf(const World&, const MapExtent&);

/// MRPT's COccupancyGridMap2D in its serialization, the contents of a .gridmap file.
/// @throws ConfigError where MRPT's single precision cannot resolve the cells
std::string toGridmap(const OccupancyGrid&);
/// Compresses bytes to a gzip file, as used by .gridmap.gz. Deterministic.
std::string gzipped(const std::string& bytes);

/// A map for ROS's map_server: black for occupied, 254 for free, 205 for unknown.
struct RosMap {
  std::string png;
  std::string yaml;
};
/// @param picture_name name of the picture's file, beside the .yaml file
RosMap toRosMap(const OccupancyGrid&, const std::string& picture_name);

enum class OctomapForm {
  binary,         ///< .bt: free or occupied
  probabilities,  ///< .ot: log-odds, here those of certainty
};

/// Serialized octomap::OcTree. A voxel is occupied if a solid overlaps it; other voxels over the surface, within the
/// heights, are free; all others are unknown.
/// @param progress called from time to time with the completed fraction, [0, 1]
/// @throws ConfigError when the world is larger than 65,536 voxels
std::string toOctomap(const World&, const MapExtent&, OctomapForm, const std::function<void(double)>& progress);

}  // namespace robosim
