#include "rendering/density_map.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "rendering/density_painter.h"
#include "rendering/ground_painter.h"
#include "rendering/path_gap.h"
#include "rendering/testing/top_view_fixture.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using Counted = DensityMap::Quantity;

const Bounds2D kArea{0, 10, 0, 5};

/// Visits of the cells of 1 m in the row 0, 1, …, from the lowest.
std::string visits(const std::vector<TPoint2D>& path, int row = 0) {
  DensityMap map(Counted::visits, {0, 4, 0, 2}, 1);
  map.addPath(path);
  std::string text;
  for (int column = 0; column < map.columns(); ++column)
    text += std::to_string(std::lround(map.perSquareMetre(column, row)));
  return text;
}

TEST(DensityMap, CountsRobotsPerSquareMetre) {
  DensityMap map(Counted::robots, kArea, 1);
  for (const TPoint2D& at : {TPoint2D(0.5, 0.5), TPoint2D(0.9, 0.1), TPoint2D(9.9, 4.9), TPoint2D(10.5, 1)})
    map.addRobot(at);
  EXPECT_EQ(map.perSquareMetre(0, 0), 2);
  EXPECT_EQ(map.perSquareMetre(9, 4), 1);
  EXPECT_EQ(cv::sum(map.levels() > 0)[0] / 255, 2) << "without that outside the area";
  DensityMap coarse(Counted::robots, kArea, 2);
  for (int i = 0; i < 2; ++i) coarse.addRobot({0.5, 0.5});
  EXPECT_EQ(coarse.perSquareMetre(0, 0), 0.5) << "2 robots on 4 m²";
  EXPECT_EQ(coarse.rows(), 3) << "of which the highest is beyond the area";
}

TEST(DensityMap, CountsTheEntriesOfPathsIntoCells) {
  EXPECT_EQ(visits({{0.5, 0.5}, {3.5, 0.5}}), "1111");
  EXPECT_EQ(visits({{0.5, 0.5}, {3.5, 0.5}, {0.5, 0.5}}), "2221") << "there and back";
  EXPECT_EQ(visits({{0.5, 0.5}, {0.5, 0.5}, {0.6, 0.5}}), "1000") << "standing is one visit";
  EXPECT_EQ(visits({{0.5, 0.5}, kPathGap, {0.6, 0.5}}), "2000") << "after a gap";
  EXPECT_EQ(visits({{-2, 0.5}, {1.5, 0.5}}), "1100") << "from outside";
  // The line crosses x = 1 at y = 0.75, y = 1 at x = 1.5, and x = 2 at y = 1.25.
  EXPECT_EQ(visits({{0.5, 0.5}, {2.5, 1.5}}), "1100");
  EXPECT_EQ(visits({{0.5, 0.5}, {2.5, 1.5}}, 1), "0110");
}

TEST(DensityMap, VisitsEveryCellOfAFinelySampledPath) {
  Rng rng(1);
  DensityMap map(Counted::visits, kArea, 0.5), sampled(Counted::robots, kArea, 0.5);
  std::vector<TPoint2D> path;
  for (int i = 0; i < 50; ++i) path.emplace_back(12 * rng.uniform() - 1, 7 * rng.uniform() - 1);
  map.addPath(path);
  constexpr int kSamples = 1000;
  for (std::size_t i = 1; i < path.size(); ++i) {
    for (int k = 0; k <= kSamples; ++k) sampled.addRobot(path[i - 1] + (path[i] - path[i - 1]) * (1.0 * k / kSamples));
  }
  const cv::Mat is_missed = (sampled.levels() > 0) & (map.levels() == 0);
  EXPECT_EQ(cv::countNonZero(is_missed), 0);
}

TEST(DensityMap, HasCellsOfRoundSizeWithSeveralRobotsEach) {
  EXPECT_EQ(DensityMap::cellSide({0, 100, 0, 100}, 10'000, 0.25), 2) << "2 robots on 2 m² need 1.4 m";
  EXPECT_EQ(DensityMap::cellSide({0, 250, 0, 250}, 10'000, 0.25), 5) << "2 robots on 12.5 m² need 3.5 m";
  EXPECT_EQ(DensityMap::cellSide({0, 12, 0, 9}, 0, 0.25), 0.5) << "visits: the diameter of a robot";
  EXPECT_EQ(DensityMap::cellSide({0, 300, 0, 9}, 0, 0.25), 2) << "at most 150 cells";
  EXPECT_EQ(DensityMap::cellSide({0, 12, 0, 9}, 3, 0.25), 1) << "few robots: at least 8 cells on the longer side";
}

TEST(DensityMap, HasAScaleThatOneExtremeCellDoesNotStretch) {
  DensityMap map(Counted::robots, {0, 20, 0, 10}, 1);
  for (int i = 0; i < 200; ++i) map.addRobot({i % 20 + 0.5, i / 20 + 0.5});
  EXPECT_EQ(map.legend(), "0 to 1 robots/m²");
  for (int i = 0; i < 50; ++i) map.addRobot({0.5, 0.5});
  EXPECT_EQ(map.top(), 1);
  EXPECT_EQ(map.legend(), "0 to 1+ robots/m²");
  DensityMap visited(Counted::visits, kArea, 0.5);
  for (int i = 0; i < 3; ++i) visited.addPath(std::vector<TPoint2D>{{1.1, 1.1}});
  EXPECT_EQ(visited.legend(), "0 to 20 visits/m²") << "3 visits on 0.25 m² are 12 per m²";
}

TEST(DensityMap, HasEightLevelsAboveEmptyCells) {
  EXPECT_EQ(DensityMap::levelOf(0, 1), 0);
  EXPECT_EQ(DensityMap::levelOf(0.001, 1), 1);
  EXPECT_EQ(DensityMap::levelOf(0.125, 1), 1);
  EXPECT_EQ(DensityMap::levelOf(0.126, 1), 2);
  EXPECT_EQ(DensityMap::levelOf(1, 1), 8);
  EXPECT_EQ(DensityMap::levelOf(5, 1), 8);
}

/// CIE lightness L* [0, 100], which also viewers without colour vision see.
double lightness(const Color& color) {
  const auto linear = [](double part) {
    return part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
  };
  const double y = 0.2126 * linear(static_cast<double>(color[0])) + 0.7152 * linear(static_cast<double>(color[1])) +
                   0.0722 * linear(static_cast<double>(color[2]));
  return 116 * std::cbrt(y) - 16;
}

TEST(DensityMap, HasColoursWhoseLightnessShowsTheirOrder) {
  for (int level = 2; level <= DensityMap::kLevels; ++level) {
    EXPECT_LT(lightness(DensityMap::colorOf(level)), lightness(DensityMap::colorOf(level - 1)) - 6) << level;
  }
}

using DensityView = TopViewTest;

/// The colour of a level on the white floor, blue, green, red.
cv::Vec3b onFloor(int level) {
  const Color color = mix(DensityMap::colorOf(level), kFloorColor, 0.1f);
  return {static_cast<std::uint8_t>(255 * color[2]), static_cast<std::uint8_t>(255 * color[1]),
          static_cast<std::uint8_t>(255 * color[0])};
}

TEST_F(DensityView, ColorsTheCellsOfRobotsFromAbove) {
  layers.density = true;
  const cv::Mat picture = TopView(world, fleet).draw(snapshot, paths, camera, layers);
  // Cells of 1 m; Ann's is from (5, 2) to (6, 3), and she covers (5, 2.5) ± 0.5.
  EXPECT_LT(cv::norm(at(picture, {5.85, 2.85}), onFloor(8), cv::NORM_INF), 4);
  EXPECT_EQ(at(picture, {3.6, 3.6}), cv::Vec3b(255, 255, 255));
  layers.only = {0, 1};
  const cv::Mat of_bob = TopView(world, fleet).draw(snapshot, paths, camera, layers);
  EXPECT_EQ(at(of_bob, {5.85, 2.85}), cv::Vec3b(255, 255, 255)) << "of the shown robots only";
}

TEST_F(DensityView, ColorsTheGroundOfA3dPictureWhereNothingCoversIt) {
  DensityMap map(Counted::robots, kArea, 1);
  map.addRobot({5.5, 2.5});
  // From 10 m above (5, 2.5), looking down; the picture's right is to the east, 20 m wide.
  cv::Mat picture(100, 200, CV_8UC3, cv::Scalar::all(255));
  const auto tint = [&](double depth_m) {
    // Inverse of metresAhead().
    const double n = kNearPlane_m, f = kFarPlane_m;
    const auto value = static_cast<float>((f - n * f / depth_m) / (f - n));
    const DepthBuffer depth{200, 100, std::vector<float>(200UL * 100, value)};
    const CameraInfo from_air{.width_px = 200, .height_px = 100, .field_of_view_rad = M_PI / 2, .rate_hz = 1};
    tintGround({picture, depth, from_air, {5, 2.5, 10, M_PI / 2, M_PI / 2, 0}}, map);
  };
  tint(5);
  EXPECT_EQ(cv::countNonZero(picture.reshape(1) != 255), 0) << "something stands on the whole ground";
  tint(10);
  EXPECT_LT(cv::norm(picture.at<cv::Vec3b>(50, 105), onFloor(8), cv::NORM_INF), 4) << "(5.5, 2.5), 10 pixels per metre";
  EXPECT_EQ(picture.at<cv::Vec3b>(50, 95), cv::Vec3b(255, 255, 255));
  EXPECT_NEAR(cv::countNonZero(picture.reshape(1) != 255) / 3, 100, 25) << "1 m²";
}

}  // namespace
}  // namespace robosim
