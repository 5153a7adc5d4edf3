// Reader of MRPT's COccupancyGridMap2D files: one object in MRPT's serialization, often compressed with gzip. Parsed
// here rather than with MRPT, whose reader allocates whatever a header claims. Format: MRPT 2.5.8,
// COccupancyGridMap2D::serializeTo(); the oldest supported version is 2, of MRPT 0.6.
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

#include <mrpt/maps/COccupancyGridMap2D.h>

#include "base/error_list.h"
#include "base/xml_element.h"
#include "world/maps/map_formats.h"
#include "world/maps/unpacked_map.h"

namespace robosim {
namespace {

/// Maximum size [bytes] of a decompressed file: the cells, and space for the rest.
constexpr std::size_t kMaxBytes = 2 * kMaxMapCells + (1u << 20);

/// The double with the shortest decimal text of a float: 0.05, not 0.05000000074505806.
double shortestDecimal(float value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return parseNumber(std::string(text, end)).value_or(value);
}

class GridmapReader {
 public:
  GridmapReader(const std::string& bytes, const std::string& path) : bytes_(bytes), path_(path) {}

  OccupancyGrid read(const OccupancyThresholds& thresholds) {
    const int version = readClass();
    const auto bits = take<std::uint8_t>("the bits of a cell");
    if (bits != 8 && bits != 16) fail("a cell has " + std::to_string(bits) + " bits; it must have 8 or 16");
    OccupancyGrid grid;
    grid.columns = take<std::uint32_t>("size_x");
    grid.rows = take<std::uint32_t>("size_y");
    const float x_min = number("x_min");
    const float x_max = number("x_max");
    const float y_min = number("y_min");
    const float y_max = number("y_max");
    const float cell_m = number("resolution");
    if (!(cell_m > 0 && cell_m <= kCellMax_m)) {
      fail("resolution is " + toText(cell_m) + "; it must lie in (0, " + toText(kCellMax_m) + "] metres");
    }
    checkSize(grid.columns, x_min, x_max, cell_m, "x");
    checkSize(grid.rows, y_min, y_max, cell_m, "y");
    if (std::uint64_t{grid.columns} * grid.rows > kMaxMapCells) {
      fail("has " + std::to_string(grid.columns) + " × " + std::to_string(grid.rows) + " cells; a map may have " +
           std::to_string(kMaxMapCells) + " at most");
    }
    grid.cell_m = shortestDecimal(cell_m);
    grid.map_from_grid = {shortestDecimal(x_min), shortestDecimal(y_min), 0};
    readCells(grid, version, bits / 8, thresholds);
    // The rest holds MRPT's insertion options and ends with the end mark of every object.
    if (at_ == bytes_.size() || bytes_.back() != '\x88') failCutOff("the end of the object");
    return grid;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw ConfigError(path_ + ": " + what); }
  [[noreturn]] void failCutOff(const std::string& what) const { fail("is cut off: " + what + " is missing"); }

  template <typename Value>
  Value take(const char* what) {
    if (bytes_.size() - at_ < sizeof(Value)) failCutOff(what);
    Value value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }

  float number(const char* what) {
    const auto value = take<float>(what);
    if (!std::isfinite(value) || std::abs(value) > kMapReach_m) {
      fail(std::string(what) + " is " + toText(value) + "; it must lie within ±1e7 metres");
    }
    return value;
  }

  int readClass() {
    const auto length = bytes_.empty() ? 0 : static_cast<unsigned char>(bytes_[0]);
    const std::string name = bytes_.substr(std::min<std::size_t>(1, bytes_.size()), length & 0x7f);
    if (length < 0x80 || (name != "mrpt::maps::COccupancyGridMap2D" && name != "COccupancyGridMap2D")) {
      fail("is not an MRPT grid map: it does not begin with a COccupancyGridMap2D");
    }
    at_ = 1 + name.size();
    constexpr int first = 2, last = 6;
    const auto version = take<std::int8_t>("the version");
    if (version < first || version > last) {
      fail("is a COccupancyGridMap2D of version " + std::to_string(version) + "; versions " + std::to_string(first) +
           " to " + std::to_string(last) + " are read");
    }
    return version;
  }

  void checkSize(std::uint32_t count, float low, float high, float cell_m, const std::string& axis) const {
    // The formula by which MRPT computes the count, which the file states redundantly.
    if (count > 0 && std::abs((double{high} - low) / cell_m - count) < 0.5) return;
    fail("size_" + axis + " is " + std::to_string(count) + ", but from " + axis + "_min to " + axis +
         "_max there are " + toText(std::round((double{high} - low) / cell_m)) + " cells");
  }

  void readCells(OccupancyGrid& grid, int version, std::size_t bytes_a_cell, const OccupancyThresholds& thresholds) {
    std::array<Occupancy, 256> occupancy_of;
    for (int i = 0; i < 256; ++i) {
      // Version 3 and later store log-odds, earlier versions probabilities; both of a cell being free.
      const double free = version >= 3 ? mrpt::maps::COccupancyGridMap2D::l2p(static_cast<std::int8_t>(i)) : i / 255.0;
      occupancy_of[static_cast<std::size_t>(i)] = thresholds.of(1 - free);
    }
    const std::size_t count = std::size_t{grid.columns} * grid.rows;
    if ((bytes_.size() - at_) / bytes_a_cell < count) {
      fail("is cut off: it has bytes for " + std::to_string((bytes_.size() - at_) / bytes_a_cell) + " of its " +
           std::to_string(count) + " cells");
    }
    grid.cells.resize(count);
    const auto* high_byte = reinterpret_cast<const unsigned char*>(bytes_.data()) + at_ + bytes_a_cell - 1;
    for (auto& cell : grid.cells) {
      cell = occupancy_of[*high_byte];
      high_byte += bytes_a_cell;
    }
    at_ += count * bytes_a_cell;
  }

  const std::string& bytes_;
  const std::string& path_;
  std::size_t at_ = 0;
};

}  // namespace

OccupancyGrid readGridmap(const std::string& bytes, const std::string& path, const OccupancyThresholds& thresholds) {
  const auto unpacked = unpackedMap(bytes, path, kMaxBytes);
  return GridmapReader(unpacked ? *unpacked : bytes, path).read(thresholds);
}

}  // namespace robosim
