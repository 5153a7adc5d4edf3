// Reader of OctoMap's files: .bt (free or occupied) and .ot (log-odds). Parsed here rather than with OctoMap, whose
// reader recurses as deep as a damaged file says. Format: OctoMap 1.9.7, AbstractOcTree::write(),
// AbstractOccupancyOcTree::writeBinary(), OccupancyOcTreeBase::writeBinaryNode() and
// OcTreeBaseImpl::writeNodesRecurs().
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <sstream>

#include "base/error_list.h"
#include "base/text_table.h"
#include "base/xml_element.h"
#include "world/maps/map_formats.h"

namespace robosim {
namespace {

/// Minimum overlap [m] of a voxel with the slice: rounding may put a face that touches its border on either side of it.
constexpr double kSliceTouch_m = 1e-7;
constexpr unsigned kOctreeDepth = 16;             ///< of every tree
constexpr std::uint32_t kVoxelsToOrigin = 32768;  ///< distance from the lowest corner to the origin

/// A cube of a tree, in voxels from its lowest corner.
struct Cube {
  std::array<std::uint32_t, 3> corner{};
  unsigned depth = 0;

  std::uint32_t side() const { return 1u << (kOctreeDepth - depth); }
  Cube child(unsigned index) const {
    Cube child{corner, depth + 1};
    for (unsigned axis = 0; axis < 3; ++axis) child.corner[axis] += (index >> axis & 1u) * child.side();
    return child;
  }
};

class OctomapReader {
 public:
  OctomapReader(const std::string& bytes, const std::string& path) : bytes_(bytes), path_(path) { readHeader(); }

  OccupancyGrid read(const HeightSpan& slice) {
    // The first pass finds the extent.
    std::array<std::uint32_t, 2> low{~0u, ~0u}, high{0, 0};
    double z_min_m = 0, z_max_m = 0;
    bool has_voxels = false;
    forAllLeaves([&](const Cube& cube, bool) {
      const HeightSpan heights = heightsOf(cube);
      z_min_m = has_voxels ? std::min(z_min_m, heights.z_min_m) : heights.z_min_m;
      z_max_m = has_voxels ? std::max(z_max_m, heights.z_max_m) : heights.z_max_m;
      has_voxels = true;
      if (!reachesInto(heights, slice)) return;
      for (std::size_t axis = 0; axis < 2; ++axis) {
        low[axis] = std::min(low[axis], cube.corner[axis]);
        high[axis] = std::max(high[axis], cube.corner[axis] + cube.side());
      }
    });
    if (!has_voxels) fail("has no voxel that is free or occupied");
    if (high[0] == 0) {
      fail("has no voxels between " + toText(slice.z_min_m) + " m and " + toText(slice.z_max_m) +
           " m; they reach from " + toText(z_min_m) + " m to " + toText(z_max_m) +
           " m: write a world with z_min and z_max in its <map>");
    }
    OccupancyGrid grid;
    grid.columns = high[0] - low[0];
    grid.rows = high[1] - low[1];
    if (std::uint64_t{grid.columns} * grid.rows > kMaxMapCells) {
      fail("has " + std::to_string(grid.columns) + " × " + std::to_string(grid.rows) +
           " cells in the slice; a map may have " + std::to_string(kMaxMapCells) + " at most");
    }
    grid.cell_m = voxel_m_;
    grid.map_from_grid = {fromCorner(low[0]), fromCorner(low[1]), 0};
    grid.cells.assign(std::size_t{grid.columns} * grid.rows, Occupancy::unknown);
    forAllLeaves([&](const Cube& cube, bool is_occupied) {
      if (!reachesInto(heightsOf(cube), slice)) return;
      for (std::uint32_t y = cube.corner[1] - low[1], i = 0; i < cube.side(); ++i, ++y) {
        const auto row =
            grid.cells.begin() + static_cast<std::ptrdiff_t>(std::size_t{y} * grid.columns + cube.corner[0] - low[0]);
        if (is_occupied) {
          std::fill(row, row + cube.side(), Occupancy::occupied);
        } else {
          std::replace(row, row + cube.side(), Occupancy::unknown, Occupancy::free);
        }
      }
    });
    return grid;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw ConfigError(path_ + ": " + what); }

  double fromCorner(std::uint32_t voxels) const {
    return (static_cast<double>(voxels) - static_cast<double>(kVoxelsToOrigin)) * voxel_m_;
  }
  HeightSpan heightsOf(const Cube& cube) const {
    return {fromCorner(cube.corner[2]), fromCorner(cube.corner[2] + cube.side())};
  }
  static bool reachesInto(const HeightSpan& voxel, const HeightSpan& slice) {
    return voxel.z_max_m > slice.z_min_m + kSliceTouch_m && voxel.z_min_m < slice.z_max_m - kSliceTouch_m;
  }

  void readHeader() {
    std::size_t at = 0;
    std::string id, size;
    for (bool is_first = true;; is_first = false) {
      const std::size_t end = bytes_.find('\n', at);
      if (is_first && !bytes_.starts_with("# Octomap OcTree ")) {
        fail("is no OctoMap: it does not begin with \"# Octomap OcTree\"");
      }
      if (end == std::string::npos) fail("is cut off: the line \"data\" is missing");
      const std::string line = bytes_.substr(at, end - at);
      at = end + 1;
      if (is_first) is_binary_ = line.find("binary") != std::string::npos;
      std::istringstream words(line);
      std::string key, value;
      words >> key >> value;
      if (key == "data") break;
      if (key == "id") id = value;
      if (key == "size") size = value;
      if (key == "res") voxel_m_ = parseNumber(value).value_or(-1);
    }
    has_color_ = id == "ColorOcTree";
    if (id != "OcTree" && id != "OcTreeStamped" && !has_color_) {
      fail("has the id '" + id + "'; OcTree, ColorOcTree and OcTreeStamped are read");
    }
    if (!(voxel_m_ > 0 && voxel_m_ <= kCellMax_m)) {
      fail("has no res in (0, " + toText(kCellMax_m) + "] metres, the side of its voxels");
    }
    is_empty_ = size == "0";
    data_ = at;
  }

  /// Calls visit(cube, is_occupied) for each known cube without children.
  template <typename Visit>
  void forAllLeaves(Visit&& visit) {
    at_ = data_;
    if (is_empty_) return;
    if (is_binary_) {
      readBinaryNode({}, visit);
    } else {
      readNode({}, visit);
    }
  }

  template <typename Value>
  Value take() {
    if (bytes_.size() - at_ < sizeof(Value)) {
      fail("is cut off: its voxels end at byte " + std::to_string(bytes_.size()) + ", in the middle of the tree");
    }
    Value value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }

  void checkDepth(const Cube& cube) const {
    if (cube.depth < kOctreeDepth) return;
    fail("is damaged: at byte " + std::to_string(at_) + " a voxel is divided below the smallest size");
  }

  /// Two bits for each child: unknown, free, occupied, or divided further.
  template <typename Visit>
  void readBinaryNode(const Cube& cube, Visit& visit) {
    checkDepth(cube);
    const auto children = take<std::uint16_t>();
    for (unsigned i = 0; i < 8; ++i) {
      const unsigned state = children >> (2 * i) & 3u;
      if (state == 1 || state == 2) visit(cube.child(i), state == 2);
    }
    for (unsigned i = 0; i < 8; ++i) {
      if ((children >> (2 * i) & 3u) == 3) readBinaryNode(cube.child(i), visit);
    }
  }

  /// The log-odds of being occupied, a colour, and a bit for each child that exists.
  template <typename Visit>
  void readNode(const Cube& cube, Visit& visit) {
    const auto log_odds = take<float>();
    if (has_color_) take<std::array<std::uint8_t, 3>>();
    const auto children = take<std::uint8_t>();
    if (children == 0) return visit(cube, log_odds >= 0);  // OctoMap's own threshold, a probability of 0.5
    checkDepth(cube);
    for (unsigned i = 0; i < 8; ++i) {
      if ((children >> i & 1u) != 0) readNode(cube.child(i), visit);
    }
  }

  const std::string& bytes_;
  const std::string& path_;
  std::size_t data_ = 0, at_ = 0;
  double voxel_m_ = -1;
  bool is_binary_ = false, has_color_ = false, is_empty_ = false;
};

}  // namespace

OccupancyGrid readOctomap(const std::string& bytes, const std::string& path, const HeightSpan& slice) {
  return OctomapReader(bytes, path).read(slice);
}

}  // namespace robosim
