#include <cmath>

#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include "world/maps/testing/map_samples.h"

namespace robosim {
namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::maps::CSimpleMap;
using mrpt::poses::CPose3D;

/// What a scanner without errors measures in a room of 4 m × 3 m about the origin, with beams all around.
mrpt::obs::CObservation2DRangeScan::Ptr scanOfRoom(double x, double y) {
  constexpr std::size_t kBeams = 721;
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->aperture = static_cast<float>(2 * M_PI);
  scan->rightToLeft = true;
  scan->maxRange = 20;
  scan->resizeScan(kBeams);
  for (std::size_t i = 0; i < kBeams; ++i) {
    const double angle = -M_PI + 2 * M_PI * static_cast<double>(i) / (kBeams - 1);
    const double to_x = ((std::cos(angle) > 0 ? 2 : -2) - x) / std::cos(angle);
    const double to_y = ((std::sin(angle) > 0 ? 1.5 : -1.5) - y) / std::sin(angle);
    scan->setScanRange(i, static_cast<float>(std::min(std::abs(to_x), std::abs(to_y))));
    scan->setScanRangeValidity(i, true);
  }
  return scan;
}

void insert(CSimpleMap& map, double x, double y, const mrpt::obs::CObservation::Ptr& observation) {
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(observation);
  map.insert(mrpt::poses::CPose3DPDFGaussian(CPose3D(x, y, 0, 0, 0, 0)), *frame);
}

CSimpleMap room() {
  CSimpleMap map;
  for (const double x : {-1.0, 0.02, 1.0}) insert(map, x, 0.02, scanOfRoom(x, 0.02));
  return map;
}

std::string bytesOf(const mrpt::serialization::CSerializable& object) {
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream) << object;
  return {static_cast<const char*>(stream.getRawBufferData()), static_cast<std::size_t>(stream.getTotalBytesCount())};
}

std::string faultOf(const std::string& bytes) {
  const auto faults = faultsOf("a.simplemap", {{"a.simplemap", bytes}});
  return faults.empty() ? "" : faults[0];
}

TEST(SimpleMap, IsTheGridThatMrptMakesOfItCellByCell) {
  COccupancyGridMap2D judge;
  judge.setSize(-1, 1, -1, 1, 0.05f);
  judge.loadFromSimpleMap(room());
  const OccupancyGrid read = readSimpleMap(bytesOf(room()), "a", 0.05, kSimpleMapThresholds);
  EXPECT_EQ(read.cell_m, 0.05);
  std::size_t known = 0;
  for (unsigned y = 0; y < judge.getSizeY(); ++y) {
    for (unsigned x = 0; x < judge.getSizeX(); ++x) {
      const double occupied = 1 - static_cast<double>(judge.getCell(static_cast<int>(x), static_cast<int>(y)));
      const double column = (static_cast<double>(judge.idx2x(static_cast<int>(x))) - read.map_from_grid.x) / 0.05;
      const double row = (static_cast<double>(judge.idx2y(static_cast<int>(y))) - read.map_from_grid.y) / 0.05;
      const bool is_inside = column >= 0 && row >= 0 && column < read.columns && row < read.rows;
      const Occupancy cell =
          is_inside ? read.at(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)) : Occupancy::unknown;
      ASSERT_EQ(cell, kSimpleMapThresholds.of(occupied)) << x << " " << y;
      known += cell != Occupancy::unknown;
    }
  }
  EXPECT_GT(known, 80u * 60u * 95 / 100) << "the room has 80 × 60 cells";
}

TEST(SimpleMap, HasTheWallsOfTheRoomItWasMadeIn) {
  useMapFormats();
  const FileTexts files{{"a.simplemap", bytesOf(room())}};
  MapReading reading;
  reading.thresholds = kSimpleMapThresholds;
  const FloorPlan plan = readMap("a.simplemap", makeProvider("world.xml", files), reading);
  EXPECT_EQ(plan.cell_m, kSimpleMapCell_m);
  const Bounds2D bounds = boundsOf(plan, {});
  EXPECT_NEAR(bounds.x_min, -2, 0.051);
  EXPECT_NEAR(bounds.x_max, 2, 0.051);
  EXPECT_NEAR(bounds.y_min, -1.5, 0.051);
  EXPECT_NEAR(bounds.y_max, 1.5, 0.051);
  EXPECT_EQ(plan.warnings, std::vector<std::string>{});
  for (const auto& cells : plan.occupied) {
    const double x = bounds.x_min + (cells.column + cells.columns / 2.0) * plan.cell_m;
    const double y = bounds.y_min + (cells.row + cells.rows / 2.0) * plan.cell_m;
    EXPECT_TRUE(std::abs(x) > 1.9 || std::abs(y) > 1.4) << x << " " << y;
  }
  reading.pixel_m = 0.1;
  EXPECT_EQ(readMap("a.simplemap", makeProvider("world.xml", files), reading).cell_m, 0.1);
}

TEST(SimpleMap, IsMadeOfRangesOfSonarsToo) {
  auto sonar = mrpt::obs::CObservationRange::Create();
  sonar->maxSensorDistance = 5;
  auto& sensed = sonar->sensedData.emplace_back();
  sensed.sensedDistance = 1;
  CSimpleMap map;
  for (int i = 0; i < 3; ++i) insert(map, 0, 0, sonar);
  const OccupancyGrid read = readSimpleMap(bytesOf(map), "a", 0.1, kSimpleMapThresholds);
  EXPECT_NEAR(read.map_from_grid.x + read.columns * read.cell_m, 1, 0.21);
  EXPECT_NE(drawn(read).find('#'), std::string::npos) << drawn(read);
}

TEST(SimpleMap, SaysWhatIsWrongWithAFile) {
  const std::string good = bytesOf(room());
  const std::string at = "maps/a.simplemap: ";
  EXPECT_EQ(faultOf(good), "");
  EXPECT_EQ(faultOf(good.substr(0, good.size() / 2)), at + "is cut off: the map ends in the middle");
  EXPECT_EQ(faultOf(bytesOf(*scanOfRoom(0, 0))), at + "is not an MRPT simple map: it does not begin with a CSimpleMap");
  EXPECT_EQ(faultOf(good.substr(0, 60) + std::string(200, '\x07')), at + "is damaged: MRPT cannot read it");
  EXPECT_EQ(faultOf(bytesOf(CSimpleMap())),
            at + "has no laser scans and no ranges of sonars or infrared sensors, of which a grid could be made");
  CSimpleMap far = room();
  insert(far, 5000, 0, scanOfRoom(0, 0));
  EXPECT_EQ(faultOf(bytesOf(far)).substr(0, 60), (at + "reaches over 5039 m × 38 m, which gives more").substr(0, 60));
  insert(far, 1e9, 0, scanOfRoom(0, 0));
  EXPECT_EQ(faultOf(bytesOf(far)), at + "is damaged: the pose of entry 5 does not lie within ±1e7 metres");
  CSimpleMap pictures;
  auto picture = mrpt::obs::CObservationImage::Create();
  picture->image.resize(8, 8, mrpt::img::CH_GRAY);
  insert(pictures, 0, 0, picture);
  EXPECT_EQ(faultOf(bytesOf(pictures)),
            at + "contains pictures, which are not read; make the map without those of cameras");
}

/// A map of one scan that `change` has damaged.
template <typename Change>
std::string faultOfScan(const Change& change) {
  CSimpleMap map;
  const auto scan = scanOfRoom(0, 0);
  change(*scan);
  insert(map, 0, 0, scan);
  return faultOf(bytesOf(map));
}

TEST(SimpleMap, RefusesNumbersFromWhichMrptWouldComputeCellsOutsideTheGrid) {
  using Scan = mrpt::obs::CObservation2DRangeScan;
  const float nan = std::nanf("");
  const auto of_entry = [](const std::string& what) {
    return "maps/a.simplemap: is damaged: " + what + " of entry 1 is not possible";
  };
  EXPECT_EQ(faultOfScan([&](Scan& scan) { scan.aperture = nan; }), of_entry("the aperture of a scan"));
  EXPECT_EQ(faultOfScan([&](Scan& scan) { scan.maxRange = nan; }), of_entry("the maximum range of a sensor"));
  EXPECT_EQ(faultOfScan([&](Scan& scan) { scan.setScanRange(7, -1e9f); }), of_entry("a range of a scan"));
  EXPECT_EQ(faultOfScan([&](Scan& scan) { scan.setScanRange(7, nan); }), of_entry("a range of a scan"));
  EXPECT_EQ(faultOfScan([&](Scan& scan) { scan.resizeScanAndAssign(100'000, 1, true); }),
            of_entry("the number of ranges of a scan"));
  EXPECT_EQ(faultOfScan([&](Scan& scan) { scan.sensorPose = CPose3D(nan, 0, 0); }), of_entry("the pose of a sensor"));
}

}  // namespace
}  // namespace robosim
