#pragma once
#include <functional>
#include <string>

#include "world/occupancy_grid.h"
#include "world/raster.h"
#include "world/world.h"

/// Exports a world as a map in formats of other programs.
namespace robosim {

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
