#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "world/map_reader.h"

namespace robosim {

/// Readers of maps of all formats.
MapReaders mapReadersOfAllFormats();
/// Lets this program read maps of all formats: calls setMapReaders(). To be called before the first world is read.
void useMapFormats();

/// @name For readMap(): one format each
/// `path` names the file in errors.
///@{
OccupancyGrid readGridmap(const std::string& bytes, const std::string& path, const OccupancyThresholds& thresholds);
/// The grid that MRPT makes of the scans and ranges in a CSimpleMap, in cells of `cell_m`; its known cells
OccupancyGrid readSimpleMap(const std::string& bytes, const std::string& path, double cell_m,
                            const OccupancyThresholds& thresholds);
/// A cell is occupied if a voxel that reaches into the slice is, free if another one is free
OccupancyGrid readOctomap(const std::string& bytes, const std::string& path, const HeightSpan& slice);
/// @param reading only is_of_ros1 is used
OccupancyGrid readRosMap(const std::string& name, const FileProvider& files, const MapReading& reading = {});
FloorPlan readActivmediaMap(const std::string& text, const std::string& path);
///@}

/// The picture that the .yaml of a ROS map refers to, as a path; empty when the file does not name one.
std::filesystem::path pictureOfRosMap(const std::filesystem::path& yaml);

}  // namespace robosim
