#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "world/occupancy_grid.h"

namespace robosim {

/// A picture as a map is read from it.
struct Picture {
  std::uint32_t columns = 0, rows = 0;
  std::uint32_t channels = 1;       ///< of which the sums are
  std::uint32_t white = 255;        ///< the largest value that a channel may have
  std::vector<std::uint32_t> sums;  ///< of each pixel's channels, row by row from the top

  /// Whether a picture's alpha counts as one more channel.
  enum class Alpha { counts, is_left_out };
};

/// Reads PNG, or portable bit-, gray- or pixmaps (PBM, PGM, PPM; plain and raw).
/// @param name of its file, for errors
/// @throws ConfigError for other bytes, a picture that is cut off or damaged, and one with more pixels than a map may
/// have cells.
Picture readPicture(const std::string& bytes, const std::string& name, Picture::Alpha alpha);

/// @name For readPicture(): one format each
///@{
bool isPng(const std::string& bytes);
Picture readPng(const std::string& bytes, const std::string& name, Picture::Alpha alpha);
bool isPortableMap(const std::string& bytes);
Picture readPortableMap(const std::string& bytes, const std::string& name);
/// @throws ConfigError unless a picture of that size may be a map
void checkPictureSize(std::uint64_t columns, std::uint64_t rows, const std::string& name);
///@}

/// How the pixels of a picture tell occupancy.
struct PictureMeaning {
  OccupancyThresholds thresholds;
  bool negate = false;      ///< the lighter, the likelier occupied; otherwise the darker
  bool is_percent = false;  ///< the value itself is the probability in percent; above 100 is unknown
};

/// A cell for each pixel. Where the grid lies, and how large a cell is, the caller knows.
OccupancyGrid gridOf(const Picture&, const PictureMeaning&);

}  // namespace robosim
