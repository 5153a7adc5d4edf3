#include <cmath>
#include <stdexcept>
#include <vector>

#include <isa-l/igzip_lib.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/serialization/CArchive.h>

#include "base/error_list.h"
#include "base/xml_element.h"
#include "world/maps/map_writer.h"

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
    throw ConfigError("MRPT's grid maps count in single precision, which cannot resolve cells of " +
                      toText(grid.cell_m) + " m so far from the origin; make them larger, or move the world");
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

std::string gzipped(const std::string& bytes) {
  std::vector<std::uint8_t> level_buffer(ISAL_DEF_LVL1_DEFAULT);
  isal_zstream stream;
  isal_deflate_stateless_init(&stream);
  stream.level = 1;
  stream.level_buf = level_buffer.data();
  stream.level_buf_size = static_cast<std::uint32_t>(level_buffer.size());
  stream.gzip_flag = IGZIP_GZIP;
  stream.end_of_stream = 1;
  stream.next_in = reinterpret_cast<std::uint8_t*>(const_cast<char*>(bytes.data()));  // only read
  stream.avail_in = static_cast<std::uint32_t>(bytes.size());
  // Upper bound of the output: stored blocks of 64 KiB with their headers.
  std::string file(bytes.size() + bytes.size() / 1024 + 1024, '\0');
  stream.next_out = reinterpret_cast<std::uint8_t*>(file.data());
  stream.avail_out = static_cast<std::uint32_t>(file.size());
  if (isal_deflate_stateless(&stream) != COMP_OK) throw std::runtime_error("a map could not be compressed");
  file.resize(stream.total_out);
  return file;
}

}  // namespace robosim
