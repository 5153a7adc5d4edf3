#include <cmath>

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/serialization/CArchive.h>

#include "base/error_list.h"
#include "base/xml_element.h"
#include "world/map_writer.h"

namespace robosim {

std::string toGridmap(const OccupancyGrid& grid) {
  const auto& corner = grid.map_from_grid;
  const auto x_min = static_cast<float>(corner.x);
  const auto y_min = static_cast<float>(corner.y);
  mrpt::maps::COccupancyGridMap2D map(x_min, static_cast<float>(corner.x + grid.columns * grid.cell_m), y_min,
                                      static_cast<float>(corner.y + grid.rows * grid.cell_m),
                                      static_cast<float>(grid.cell_m));
  const double off_m = std::max(std::abs(map.getXMin() - corner.x), std::abs(map.getYMin() - corner.y));
  if (map.getSizeX() != grid.columns || map.getSizeY() != grid.rows || off_m > grid.cell_m / 100) {
    throw ConfigError("MRPT's grid maps count in single precision, which cannot tell cells of " + toText(grid.cell_m) +
                      " m apart so far from the origin; make them larger, or move the world");
  }
  for (std::uint32_t row = 0; row < grid.rows; ++row) {
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      const Occupancy cell = grid.at(column, row);
      const float free = cell == Occupancy::free ? 1.0f : cell == Occupancy::occupied ? 0.0f : 0.5f;
      map.setCell(static_cast<int>(column), static_cast<int>(row), free);
    }
  }
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream) << map;
  return {static_cast<const char*>(stream.getRawBufferData()), static_cast<std::size_t>(stream.getTotalBytesCount())};
}

}  // namespace robosim
