#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "base/error_list.h"
#include "geometry/scene.h"
#include "world/maps/testing/map_samples.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;

FloorPlan planOf(const std::string& text) { return readActivmediaMap("2D-Map\n" + text, "a.map"); }

TEST(ActivmediaMap, MakesWallsTwoMillimetresWideWithClosedCorners) {
  const FloorPlan plan = planOf("LINES\n-2500 -2500 -2500 2500\n-2500 2500 2500 2500\n");
  ASSERT_EQ(plan.boxes.size(), 2u);
  EXPECT_EQ(plan.boxes[0], (PlanBox{{-2.5, 0, M_PI / 2}, 5.002, 0.002}));
  EXPECT_EQ(plan.boxes[1], (PlanBox{{0, 2.5, 0}, 5.002, 0.002}));
  std::vector<Solid> solids;
  addSolids(plan, {}, {0, 1}, solids);
  const Scene scene(solids, 0, {-3, 3, -3, 3});
  EXPECT_NEAR(scene.castRay(Ray::towards({0, 0, 0.5}, M_PI / 2), 9).distance_m, 2.499, 1e-8);
  EXPECT_NEAR(scene.castRay(Ray::towards({0, 0, 0.5}, M_PI), 9).distance_m, 2.499, 1e-8);
  // Straight at the corner, where walls without extended ends would leave a notch.
  EXPECT_NEAR(scene.castRay(Ray::towards({0, 0, 0.5}, 3 * M_PI / 4), 9).distance_m, 2.499 * std::sqrt(2), 1e-8);
}

TEST(ActivmediaMap, ConvertsPointsToCellsCentredOnThem) {
  const FloorPlan plan = planOf("Resolution: 50\nDATA\n100 200\n150 200\n100 200\n-50 300\n");
  EXPECT_EQ(plan.cell_m, 0.05);
  EXPECT_EQ(plan.columns, 5u);
  EXPECT_EQ(plan.rows, 3u);
  EXPECT_EQ(plan.occupied, (std::vector<CellRectangle>{{3, 0, 2, 1}, {0, 2, 1, 1}}));
  EXPECT_NEAR(plan.map_from_grid.x, -0.075, 1e-12);
  EXPECT_NEAR(plan.map_from_grid.y, 0.175, 1e-12);
  EXPECT_EQ(planOf("Resolution: 0\nDATA\n100 200\n").cell_m, 0.02) << "0 stands for 20 mm";
  EXPECT_EQ(planOf("DATA\n100 200\n").cell_m, 0.02);
}

TEST(ActivmediaMap, IgnoresTheDeclaredCountsAndBounds) {
  const FloorPlan plan = planOf(
      "NumLines: 1\nLineMinPos: 0 0\nLineMaxPos: 1 1\nNumPoints: 7\n"
      "LINES\n0 0 1000 0\n5000 0 5000 9000\nDATA\n");
  EXPECT_EQ(plan.boxes.size(), 2u);
  EXPECT_EQ(plan.columns, 0u);
}

TEST(ActivmediaMap, AcceptsAllHeaderAndWhitespaceVariants) {
  // DOS line ends, any header, tabs, leading blanks, decimals, trailing words, empty lines, DATA first, no final
  // newline.
  const FloorPlan plan = readActivmediaMap(
      "2d-MAP-ex2 \r\nSources: one\r\n\r\nDATA\r\n 10\t20 and so on\r\n\r\nLINES\r\n\t0 0.5 1000.25 0.5 7\r\n0 0 0 0",
      "a.map");
  EXPECT_EQ(plan.occupied.size(), 1u);
  ASSERT_EQ(plan.boxes.size(), 2u);
  EXPECT_NEAR(plan.boxes[0].length_m, 1.00225, 1e-12);
  EXPECT_EQ(plan.boxes[1], (PlanBox{{0, 0, 0}, 0.002, 0.002})) << "a wall without length is a dot";
}

TEST(ActivmediaMap, ReadsTheSectionsOfOtherScanners) {
  const FloorPlan plan = planOf("Sources: Laser2\nLaser2_LINES\n0 0 1000 0\nLaser2_DATA\n0 0\n");
  EXPECT_EQ(plan.boxes.size(), 1u);
  EXPECT_EQ(plan.occupied.size(), 1u);
}

TEST(ActivmediaMap, ReportsStartPosesBestFirst) {
  const FloorPlan plan = planOf(
      "Cairn: DockPioneer 1000 0 90 \"\" ICON \"the dock\"\n"
      "Cairn: RobotHome 7 7 90 \"\" ICON \"an area\" 0 0 2000 1000\n"
      "Cairn: RobotHome 3000 4000 -45.5 \"\" ICON \"\"\n"
      "Cairn: Goal 1 2 0 \"\" ICON \"no start\"\n");
  ASSERT_EQ(plan.starts.size(), 3u);
  EXPECT_EQ(plan.starts[0], TPose2D(3, 4, toRadians(-45.5)));
  // The area's middle, (1, 0.5), is given in a frame rotated by 90° about the map's origin.
  EXPECT_NEAR(plan.starts[1].x, -0.5, 1e-12);
  EXPECT_NEAR(plan.starts[1].y, 1, 1e-12);
  EXPECT_EQ(plan.starts[2], TPose2D(1, 0, M_PI / 2));
}

TEST(ActivmediaMap, HasThePlaceOfItsOriginOnTheEarth) {
  EXPECT_EQ(planOf("OriginLatLongAlt: 42.807 -71.58 50\n").origin, (GeoPosition{42.807, -71.58, 50}));
  EXPECT_EQ(planOf("").origin, std::nullopt);
  EXPECT_THROW(planOf("OriginLatLongAlt: 42.807 -181 50\n"), ConfigError);
}

TEST(ActivmediaMap, ConvertsReflectorsAndObstaclesToWallsButNotForbiddenLines) {
  const FloorPlan plan = planOf(
      "Cairn: Box 0 0 90 \"\" ICON \"a box\" 1000 0 2000 500\n"
      "MapInfo: SectorType Name=Box \"Label=A box\" Sim.Obstacle=yes\n"
      "MapInfo: SectorType Name=Rug Sim.Obstacle=no\n"
      "Cairn: Rug 0 0 0 \"\" ICON \"\" 0 0 1 1\n"
      "Cairn: Reflector 0 0 0 \"\" ICON \"\" 0 0 1000 0\n"
      "Cairn: ForbiddenLine 0 0 0 \"\" ICON \"\" 0 0 1000 0\n"
      "Cairn: ForbiddenArea 0 0 0 \"\" ICON \"\" 0 0 1000 1000\n");
  ASSERT_EQ(plan.boxes.size(), 2u);
  EXPECT_NEAR(plan.boxes[0].map_from_box.x, -0.25, 1e-12);
  EXPECT_NEAR(plan.boxes[0].map_from_box.y, 1.5, 1e-12);
  EXPECT_EQ(plan.boxes[0].length_m, 1);
  EXPECT_EQ(plan.boxes[0].width_m, 0.5);
  EXPECT_EQ(plan.boxes[1], (PlanBox{{0.5, 0, 0}, 1.002, 0.002}));
}

TEST(ActivmediaMap, AcceptsWallsUpToTheLimitOfBoxes) {
  std::string text = "2D-Map\nLINES\n";
  for (std::size_t i = 0; i < kMaxMapBoxes; ++i) text += "0 0 1 1\n";
  EXPECT_EQ(readActivmediaMap(text, "many.map").boxes.size(), kMaxMapBoxes);
  text += "0 0 1 1\n";
  try {
    readActivmediaMap(text, "many.map");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "many.map:4000003: is the wall or box beyond the 4000000 that a map may have; use fewer");
  }
}

}  // namespace
}  // namespace robosim
