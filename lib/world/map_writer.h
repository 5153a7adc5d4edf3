#pragma once
#include <functional>
#include <string>

#include "world/occupancy_grid.h"
#include "world/world.h"

/// A world as maps of the formats that other programs read. All that stands still is on them; robots are not.
namespace robosim {

/// Which part of a world is mapped, and how finely.
struct MapExtent {
  double cell_m = 0.05;  ///< side of a cell or voxel, (0, kCellMax_m]; cells lie at multiples of it
  HeightSpan heights;    ///< a grid has what stands within; an OctoMap reaches from one to the other
};

/// The heights that the robots of a world take up, 0 to 1 m if there are none: what stands there is in their way.
HeightSpan robotHeights(const std::vector<HeightSpan>& robots);
/// From the ground, or the lowest underside, to the highest top of all that stands still; 0 to 1 m if nothing does.
HeightSpan heightsOfAll(const World&);

/// The world from above, as far as it and all that stands in it reaches: a cell is occupied when something within the
/// heights shares some of its ground, however little; of the others those on the surface are free, those beyond are
/// unknown.
/// @throws ConfigError when there were more than kMostMapCells.
OccupancyGrid rasterOf(const World&, const MapExtent&);

/// MRPT's COccupancyGridMap2D in its serialization: what its own programs open as a .gridmap.
/// @throws ConfigError where MRPT's single precision cannot tell the cells apart.
std::string toGridmap(const OccupancyGrid&);

/// What ROS's map_server takes: black for occupied, 254 for free, 205 for unknown.
struct RosMap {
  std::string png;
  std::string yaml;
};
/// @param picture_name of the file that the picture will be in, beside the .yaml
RosMap toRosMap(const OccupancyGrid&, const std::string& picture_name);

enum class OctomapForm {
  binary,         ///< .bt: free or occupied
  probabilities,  ///< .ot: log-odds, here those of certainty
};

/// An octomap::OcTree: a voxel is occupied when some solid shares some of its volume; of the others those over the
/// surface, within the heights, are free; all else is unknown.
/// @param progress is called now and then with the share that is done, [0, 1]
/// @throws ConfigError when the world is larger than 65,536 voxels.
std::string toOctomap(const World&, const MapExtent&, OctomapForm, const std::function<void(double)>& progress);

}  // namespace robosim
