#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "world/occupancy_grid.h"

namespace robosim {

/// A picture from which a map is read.
struct Picture {
  std::uint32_t columns = 0, rows = 0;
  std::uint32_t channels = 1;        ///< number of channels added up in `sums`
  std::uint32_t white = 255;         ///< the maximum value of a channel
  std::vector<std::uint32_t> sums;   ///< sum of each pixel's channels, row by row from the top
  std::vector<bool> is_transparent;  ///< by pixel: not fully opaque; empty if all are opaque

  /// Meaning of the alpha channel.
  enum class Alpha {
    counts,         ///< one more channel of a pixel's value, as in the mode `trinary` of ROS 1
    is_left_out,    ///< none, as in the mode `scale` of ROS 1
    marks_unknown,  ///< pixels that are not fully opaque are unknown, as in nav2
    only_red,       ///< none, and of the colours only red counts, as in Stage
  };
};

/// Reads PNG, JPEG, BMP (1, 4, 8, 16, 24 or 32 bits, not compressed), PBM, PGM or PPM (plain and raw).
/// @param name name of the file, for errors
/// @throws ConfigError for other formats, truncated or damaged pictures, and pictures with more pixels than a map may
/// have cells
Picture readPicture(const std::string& bytes, const std::string& name, Picture::Alpha alpha);

/// @name Implementation of readPicture(): one format each
///@{
bool isPng(const std::string& bytes);
Picture readPng(const std::string& bytes, const std::string& name, Picture::Alpha alpha);
bool isBmp(const std::string& bytes);
Picture readBmp(const std::string& bytes, const std::string& name, Picture::Alpha alpha);
bool isPortableMap(const std::string& bytes);
Picture readPortableMap(const std::string& bytes, const std::string& name, Picture::Alpha alpha);
/// @throws ConfigError unless a map may have this size
void checkPictureSize(std::uint64_t columns, std::uint64_t rows, const std::string& name);
///@}

/// Conversion of pixel values to occupancy.
struct PixelInterpretation {
  OccupancyThresholds thresholds;
  bool negate = false;      ///< whether lighter pixels are more likely occupied; otherwise darker ones are
  bool is_percent = false;  ///< the value is the probability in percent; above 100: unknown
};

/// Converts each pixel to a cell. The caller sets the grid's pose and cell size.
OccupancyGrid gridOf(const Picture&, const PixelInterpretation&);

}  // namespace robosim
