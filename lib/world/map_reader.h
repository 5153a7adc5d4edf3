#pragma once
#include <string>

#include "world/file_shelf.h"
#include "world/floor_plan.h"

namespace robosim {

enum class MapFormat {
  gridmap,     ///< MRPT's COccupancyGridMap2D, compressed or not
  ros_yaml,    ///< ROS's map_server: a .yaml file that names a picture
  picture,     ///< PNG, PGM, PPM or PBM
  activmedia,  ///< 2D-Map: walls as lines, and points
};

/// What a file's name says of it (.gridmap, .gridmap.gz, .yaml, .yml, .png, .pgm, .ppm, .pbm, .map).
/// @throws ConfigError for any other name
MapFormat mapFormatOf(const std::filesystem::path& file);
/// Whether mapFormatOf() knows it.
bool isMapFile(const std::filesystem::path& file);

/// What a world may say about how a map of its is read. Which of it means something depends on the format.
struct MapReading {
  double pixel_m = 0;                ///< picture: side of a pixel
  OccupancyThresholds thresholds;    ///< gridmap, picture
  bool negate = false;               ///< picture: lighter is occupied
  bool unknown_is_occupied = false;  ///< gridmap, ros_yaml, picture
  bool operator==(const MapReading&) const = default;
};

/// Reads a map.
/// @param name as FileShelf has it
/// @throws ConfigError with what is wrong, and where: a line of the file, or a field of its header.
FloorPlan readMap(const std::string& name, const FileShelf& shelf, const MapReading& reading);

/// @name For readMap(): one format each
/// `path` names the file in errors.
///@{
OccupancyGrid readGridmap(const std::string& bytes, const std::string& path, const OccupancyThresholds& thresholds);
OccupancyGrid readRosMap(const std::string& name, const FileShelf& shelf);
FloorPlan readActivmediaMap(const std::string& text, const std::string& path);
///@}

}  // namespace robosim
