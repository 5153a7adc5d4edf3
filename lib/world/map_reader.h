#pragma once
#include <string>

#include "world/file_provider.h"
#include "world/floor_plan.h"

namespace robosim {

enum class MapFormat {
  gridmap,     ///< MRPT's COccupancyGridMap2D, compressed or not
  ros_yaml,    ///< ROS map_server: a .yaml file that refers to a picture
  picture,     ///< PNG, PGM, PPM or PBM
  activmedia,  ///< 2D-Map: walls as lines, and points
};

/// Format of a map file by its name (.gridmap, .gridmap.gz, .yaml, .yml, .png, .pgm, .ppm, .pbm, .map).
/// @throws ConfigError for any other name
MapFormat mapFormatOf(const std::filesystem::path& file);
/// Whether mapFormatOf() recognises the file's name.
bool isMapFile(const std::filesystem::path& file);

/// Options of a world file for reading a map. Each applies to the given formats only.
struct MapReading {
  double pixel_m = 0;                ///< picture: side of a pixel
  OccupancyThresholds thresholds;    ///< gridmap, picture
  bool negate = false;               ///< picture: lighter is occupied
  bool unknown_is_occupied = false;  ///< gridmap, ros_yaml, picture
  bool operator==(const MapReading&) const = default;
};

/// Reads a map.
/// @param name a FileProvider name
/// @throws ConfigError with the fault and its location: a line of the file, or a field of its header
FloorPlan readMap(const std::string& name, const FileProvider& files, const MapReading& reading);

/// @name For readMap(): one format each
/// `path` names the file in errors.
///@{
OccupancyGrid readGridmap(const std::string& bytes, const std::string& path, const OccupancyThresholds& thresholds);
OccupancyGrid readRosMap(const std::string& name, const FileProvider& files);
FloorPlan readActivmediaMap(const std::string& text, const std::string& path);
///@}

}  // namespace robosim
