// Reader of MRPT's simple maps: poses with what was observed there, of which MRPT makes the grid, with its default
// options of insertion (beams count up to 15 m).
#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/serialization/CArchive.h>

#include "base/error_list.h"
#include "base/memory_bound.h"
#include "base/xml_element.h"
#include "world/maps/map_formats.h"
#include "world/maps/unpacked_map.h"

namespace robosim {
namespace {

/// Maximum size [bytes] of a decompressed file, and of the memory that MRPT may use to read it.
constexpr std::size_t kMaxSimpleMapBytes = std::size_t{512} << 20;
constexpr std::size_t kMaxSimpleMapMemory = std::size_t{2} << 30;

/// Maximum number of ranges of a scan: MRPT keeps them on the stack.
constexpr std::size_t kBeamsMax = 65'536;

/// Distance [m] beyond a beam's end up to which MRPT enlarges a grid.
constexpr double kGridMargin_m = 4;
/// Half the side [m] of the grid with which MRPT begins, about the origin.
constexpr float kFirstHalf_m = 10;

/// An MRPT archive that reads a text, and refuses pictures: MRPT's decoder ends the process at a damaged one.
class TextArchive final : public mrpt::serialization::CArchive {
 public:
  explicit TextArchive(const std::string& bytes) : bytes_(bytes) {}

  std::string getArchiveDescription() const override { return "simple map"; }
  bool atEnd() const { return at_ == bytes_.size(); }
  bool hasPictures() const { return has_pictures_; }

 protected:
  std::size_t write(const void*, std::size_t) override { throw std::logic_error("TextArchive only reads"); }
  std::size_t read(void* to, std::size_t size) override {
    const std::size_t got = std::min(size, bytes_.size() - at_);
    std::memcpy(to, bytes_.data() + at_, got);
    at_ += got;
    const std::string_view read(static_cast<const char*>(to), got);
    has_pictures_ = read == "CImage" || read.ends_with("::CImage") || read == "CMRPTImage";
    if (has_pictures_) throw std::runtime_error("a picture");
    return got;
  }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
  bool has_pictures_ = false;
};

class SimpleMapReader {
 public:
  explicit SimpleMapReader(const std::string& path) : path_(path) {}

  OccupancyGrid read(const std::string& bytes, double cell_m, const OccupancyThresholds& thresholds) const {
    const mrpt::maps::CSimpleMap all = parsed(bytes);
    mrpt::maps::CSimpleMap used;
    Bounds2D reach{-kFirstHalf_m, kFirstHalf_m, -kFirstHalf_m, kFirstHalf_m};
    for (std::size_t i = 0; i < all.size(); ++i) addUsed(all, i, used, reach);
    if (used.empty()) {
      fail("has no laser scans and no ranges of sonars or infrared sensors, of which a grid could be made");
    }
    const double columns = (reach.x_max - reach.x_min) / cell_m, rows = (reach.y_max - reach.y_min) / cell_m;
    if (!(columns * rows <= static_cast<double>(kMaxMapCells))) {
      fail("reaches over " + toText(std::round(reach.x_max - reach.x_min)) + " m × " +
           toText(std::round(reach.y_max - reach.y_min)) + " m, which gives more than " + std::to_string(kMaxMapCells) +
           " cells of " + toText(cell_m) + " m; set a larger resolution in its <map>");
    }
    mrpt::maps::COccupancyGridMap2D grid;
    grid.setSize(-kFirstHalf_m, kFirstHalf_m, -kFirstHalf_m, kFirstHalf_m, static_cast<float>(cell_m));
    try {
      grid.loadFromSimpleMap(used);
    } catch (const std::exception&) {
      fail("is damaged: MRPT cannot make a grid of it");
    }
    return trimmed(grid, cell_m, thresholds);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw ConfigError(path_ + ": " + what); }

  mrpt::maps::CSimpleMap parsed(const std::string& bytes) const {
    TextArchive archive(bytes);
    MemoryBound bound(kMaxSimpleMapMemory);
    bound.measure();
    try {
      mrpt::serialization::CSerializable::Ptr object;
      {
        // MRPT allocates as much memory as a number in the file specifies.
        const MemoryBound::Hold hold(bound);
        object = archive.ReadObject<mrpt::serialization::CSerializable>();
      }
      if (const auto map = std::dynamic_pointer_cast<mrpt::maps::CSimpleMap>(object)) return *map;
    } catch (const std::bad_alloc&) {
      fail("is damaged: an entry requests more than 2 GiB");
    } catch (const std::exception&) {
      if (archive.hasPictures()) {
        fail("contains pictures, which are not read; make the map without those of cameras");
      }
      fail(archive.atEnd() ? "is cut off: the map ends in the middle" : "is damaged: MRPT cannot read it");
    }
    fail("is not an MRPT simple map: it does not begin with a CSimpleMap");
  }

  /// Adds what a grid is made of in an entry, and the part of the ground that it reaches.
  void addUsed(const mrpt::maps::CSimpleMap& all, std::size_t index, mrpt::maps::CSimpleMap& used,
               Bounds2D& reach) const {
    const auto entry = all.get(index);
    const auto& [pose, frame] = entry;
    if (!pose || !frame) return;
    auto kept = mrpt::obs::CSensoryFrame::Create();
    double reach_m = 0;
    const auto fail_of = [&](const std::string& what) {
      fail("is damaged: " + what + " of entry " + std::to_string(index + 1) + " is not possible");
    };
    for (const auto& observation : *frame) {
      const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(observation);
      const auto range = std::dynamic_pointer_cast<mrpt::obs::CObservationRange>(observation);
      if (!scan && !range) continue;
      // MRPT's insertion computes indices of cells from all of these, without checks.
      observation->getSensorPose(place_->sensorPose);
      if (!isFinite(place_->sensorPose) || !(place_->sensorPose.norm() <= kMapReach_m)) fail_of("the pose of a sensor");
      const auto max_m = static_cast<double>(scan ? scan->maxRange : range->maxSensorDistance);
      if (!std::isfinite(max_m) || max_m < 0) fail_of("the maximum range of a sensor");
      if (scan) checkScan(*scan, fail_of);
      if (range) checkRanges(*range, fail_of);
      reach_m = std::max(reach_m, place_->sensorPose.norm() + std::min(max_m, insertion_.maxDistanceInsertion + 0.0));
      kept->insert(observation);
    }
    if (kept->empty()) return;
    pose->getMean(place_->sensorPose);
    const auto& mean = place_->sensorPose;
    if (!isFinite(mean) || !(std::abs(mean.x()) <= kMapReach_m && std::abs(mean.y()) <= kMapReach_m)) {
      fail("is damaged: the pose of entry " + std::to_string(index + 1) + " does not lie within ±1e7 metres");
    }
    const double r = reach_m + kGridMargin_m;
    const Bounds2D here{mean.x() - r, mean.x() + r, mean.y() - r, mean.y() + r};
    reach = {std::min(reach.x_min, here.x_min), std::max(reach.x_max, here.x_max), std::min(reach.y_min, here.y_min),
             std::max(reach.y_max, here.y_max)};
    used.insert(*pose, *kept);
  }

  static bool isFinite(const auto& pose) {
    const auto& rotation = pose.getRotationMatrix();
    double sum = pose.x() + pose.y() + pose.z();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) sum += rotation(row, column);
    }
    return std::isfinite(sum);
  }

  template <typename Fail>
  static void checkScan(const mrpt::obs::CObservation2DRangeScan& scan, const Fail& fail_of) {
    if (!std::isfinite(scan.aperture) || std::abs(scan.aperture) > 2 * M_PI + 1e-3) fail_of("the aperture of a scan");
    if (scan.getScanSize() > kBeamsMax) fail_of("the number of ranges of a scan");
    for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
      const float range_m = scan.getScanRange(i);
      if (scan.getScanRangeValidity(i) && !(std::isfinite(range_m) && range_m >= 0)) fail_of("a range of a scan");
    }
  }

  template <typename Fail>
  static void checkRanges(const mrpt::obs::CObservationRange& ranges, const Fail& fail_of) {
    if (!std::isfinite(ranges.sensorConeApperture) || std::abs(ranges.sensorConeApperture) > 2 * M_PI + 1e-3)
      fail_of("the aperture of a sensor");
    if (ranges.sensedData.size() > kBeamsMax) fail_of("the number of ranges of a sensor");
    for (const auto& one : ranges.sensedData) {
      const auto& pose = one.sensorPose;
      for (const double value : {pose.x, pose.y, pose.z, pose.yaw, pose.pitch, pose.roll}) {
        if (!(std::abs(value) <= kMapReach_m)) fail_of("the pose of a sensor");
      }
      if (!(std::isfinite(one.sensedDistance) && one.sensedDistance >= 0)) fail_of("a range of a sensor");
    }
  }

  /// The rectangle of the cells of which something is known.
  OccupancyGrid trimmed(const mrpt::maps::COccupancyGridMap2D& all, double cell_m,
                        const OccupancyThresholds& thresholds) const {
    const auto occupied = [&](int x, int y) { return 1 - static_cast<double>(all.getCell(x, y)); };
    const double untouched = 1 - static_cast<double>(mrpt::maps::COccupancyGridMap2D::l2p(0));
    int left = static_cast<int>(all.getSizeX()), right = -1, bottom = static_cast<int>(all.getSizeY()), top = -1;
    for (int y = 0; y < static_cast<int>(all.getSizeY()); ++y) {
      for (int x = 0; x < static_cast<int>(all.getSizeX()); ++x) {
        if (occupied(x, y) == untouched) continue;
        left = std::min(left, x), right = std::max(right, x), bottom = std::min(bottom, y), top = std::max(top, y);
      }
    }
    if (right < 0) fail("gives an empty grid: its scans have no valid ranges, or are not level");
    OccupancyGrid grid;
    grid.columns = static_cast<std::uint32_t>(right - left + 1);
    grid.rows = static_cast<std::uint32_t>(top - bottom + 1);
    grid.cell_m = cell_m;
    const auto corner = [&](float min, int cells) {
      return (std::round(static_cast<double>(min) / cell_m) + cells) * cell_m;
    };
    grid.map_from_grid = {corner(all.getXMin(), left), corner(all.getYMin(), bottom), 0};
    for (int y = bottom; y <= top; ++y) {
      for (int x = left; x <= right; ++x) grid.cells.push_back(thresholds.of(occupied(x, y)));
    }
    return grid;
  }

  const std::string& path_;
  mrpt::maps::COccupancyGridMap2D::TInsertionOptions insertion_;
  /// Holds a pose for the check of the size: modules whose results are the same on every processor make none
  /// themselves.
  mrpt::obs::CObservation2DRangeScan::Ptr place_ = std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(
      mrpt::rtti::classFactory("CObservation2DRangeScan"));
};

}  // namespace

OccupancyGrid readSimpleMap(const std::string& bytes, const std::string& path, double cell_m,
                            const OccupancyThresholds& thresholds) {
  const auto unpacked = unpackedMap(bytes, path, kMaxSimpleMapBytes);
  return SimpleMapReader(path).read(unpacked ? *unpacked : bytes, cell_m, thresholds);
}

}  // namespace robosim
