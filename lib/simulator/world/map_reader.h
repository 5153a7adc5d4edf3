#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "world/file_provider.h"
#include "world/floor_plan.h"

namespace robosim {

enum class MapFormat {
  gridmap,     ///< MRPT's COccupancyGridMap2D, compressed or not
  simple_map,  ///< MRPT's CSimpleMap, compressed or not
  octomap,     ///< OctoMap's voxels, of which a slice is read
  ros_yaml,    ///< ROS map_server: a .yaml file that refers to a picture
  picture,     ///< PNG, JPEG, BMP, PGM, PPM or PBM
  activmedia,  ///< 2D-Map: walls as lines, and points
};

/// Format of a map file by its name (.gridmap, .gridmap.gz, .simplemap, .simplemap.gz, .bt, .ot, .yaml, .yml, .png,
/// .jpg, .jpeg, .bmp, .pgm, .ppm, .pbm, .map).
/// @throws ConfigError for any other name
MapFormat recognizeMapFormat(const std::filesystem::path& file);
/// Whether recognizeMapFormat() recognises the file's name.
bool isMapFile(const std::filesystem::path& file);

/// Of a grid that is made of a simple map.
constexpr double kSimpleMapCell_m = 0.05;
/// A cell of a simple map's grid is occupied when MRPT has seen more beams end there than pass, free in the opposite
/// case: one beam alone gives 0.65 or 0.35.
constexpr OccupancyThresholds kSimpleMapThresholds{.occupied = 0.6, .free = 0.4, .are_inclusive = false};
/// From above a floor's voxels to the height of walls.
constexpr HeightSpan kOctomapSlice{0.1, 1};

/// Options of a world file for reading a map. Each applies to the given formats only.
struct MapReading {
  double pixel_m = 0;                ///< picture: side of a pixel; simple_map: of a cell, 0 for kSimpleMapCell_m
  OccupancyThresholds thresholds;    ///< gridmap, simple_map, picture
  bool negate = false;               ///< picture: lighter is occupied
  bool unknown_is_occupied = false;  ///< all but activmedia
  bool is_of_ros1 = false;           ///< ros_yaml, picture: thresholds and alpha as in ROS 1; otherwise as in nav2
  /// picture: as a bitmap of Stage: its first channel counts, pixels up to half of white are occupied, others free
  bool is_of_stage = false;
  double pixel_y_m = 0;              ///< picture: height of a pixel, if it differs from its width; 0: a square
  HeightSpan slice = kOctomapSlice;  ///< octomap: heights in the map; voxels that reach into them count
  bool operator==(const MapReading&) const = default;
};

/// Reads a map, by MapReaders::read.
/// @param name a FileProvider name
/// @throws ConfigError with the fault and its location: a line of the file, or a field of its header
FloorPlan readMap(const std::string& name, const FileProvider& files, const MapReading& reading);

/// The regular files that a map consists of: its own, and the picture that the .yaml of a ROS map refers to.
std::vector<std::filesystem::path> filesOfMap(const std::filesystem::path& map);

/// Functions of the library robosim::maps, which depends on libraries for pictures, YAML and MRPT's maps.
struct MapReaders {
  FloorPlan (*read)(const std::string& name, const FileProvider& files, const MapReading& reading) = nullptr;
  std::vector<std::filesystem::path> (*files)(const std::filesystem::path& map) = nullptr;
};
/// Sets the functions for this process, before the first world is read. Without them, worlds with maps are refused.
void setMapReaders(const MapReaders& readers);

}  // namespace robosim
