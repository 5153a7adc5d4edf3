#pragma once
#include <string>
#include <vector>

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/serialization/CArchive.h>
#include <opencv2/imgcodecs.hpp>

#include "base/error_list.h"
#include "world/maps/map_formats.h"

/// Map files for tests, written by the libraries that define the formats.
namespace robosim {

/// A grid map as written by MRPT.
inline std::string gridmapBytes(const mrpt::maps::COccupancyGridMap2D& grid) {
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream) << grid;
  return {static_cast<const char*>(stream.getRawBufferData()), static_cast<std::size_t>(stream.getTotalBytesCount())};
}

/// A picture as written by OpenCV.
inline std::string pngBytes(const cv::Mat& picture) {
  std::vector<unsigned char> bytes;
  cv::imencode(".png", picture, bytes);
  return {bytes.begin(), bytes.end()};
}

/// A .yaml file as written by ROS's map_saver.
inline std::string rosYaml(const std::string& image) {
  return "image: " + image +
         "\nresolution: 0.05\norigin: [-1.5, 2.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

/// Errors of readMap() given only these files, line by line; empty when it succeeds.
inline std::vector<std::string> faultsOf(const std::string& name, const FileTexts& files,
                                         const MapReading& reading = {}) {
  useMapFormats();
  try {
    readMap(name, makeProvider("maps/world.xml", files), reading);
    return {};
  } catch (const ConfigError& error) {
    return error.errors();
  }
}

/// The cells of a grid, from the top: '.' free, '#' occupied, '?' unknown.
inline std::string drawn(const OccupancyGrid& grid) {
  std::string text;
  for (std::uint32_t row = grid.rows; row-- > 0;) {
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      text += ".#?"[static_cast<std::size_t>(grid.at(column, row))];
    }
    text += '\n';
  }
  return text;
}

}  // namespace robosim
