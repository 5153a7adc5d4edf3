// Layers and selected robots, in views from above, 3D panes and figures.
#include "robots/view_layers.h"

#include <numbers>
#include <set>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "rendering/panes.h"
#include "rendering/run_figure.h"
#include "rendering/snapshot_run.h"
#include "rendering/testing/top_view_fixture.h"

namespace robosim {
namespace {

const cv::Vec3b kFloor(255, 255, 255);

/// Whether a pixel is that of the floor or its grid.
bool isFloor(const cv::Vec3b& pixel) { return cv::norm(pixel, kFloor, cv::NORM_INF) < 40; }

/// Ann and Bob have driven 2 m to where they are.
struct ViewLayersTest : TopViewTest {
  ViewLayersTest() {
    for (auto& robot : snapshot.robots) {
      robot.world_from_robot.x -= 2;
      robot.readings.emplace().measurements = {Echoes{{2, {2.5F, 0, 0.2F}}}};
    }
    paths.add(snapshot);
    for (int i = 0; i < 4; ++i) {
      ++snapshot.step;
      snapshot.time_s += 0.5;
      for (auto& robot : snapshot.robots) robot.world_from_robot.x += 0.5;
      paths.add(snapshot);
    }
  }

  DrawnRun drawn() const { return drawnRun(fleet, snapshot, paths, layers); }
  cv::Mat figure() const {
    const std::string png = runFigure(PictureFormat::png, world, fleet, drawn());
    return cv::imdecode(cv::Mat(1, static_cast<int>(png.size()), CV_8U, const_cast<char*>(png.data())),
                        cv::IMREAD_COLOR);
  }
  /// A PNG figure has two pixels per pixel of its view.
  cv::Vec3b inFigure(const cv::Mat& picture, const mrpt::math::TPoint2D& place) const {
    const auto pixel = figureView(world, drawn()).toPixel(place) * 2.0 + mrpt::math::TPoint2D(0.5, 0.5);
    return picture.at<cv::Vec3b>(static_cast<int>(std::lround(pixel.y)), static_cast<int>(std::lround(pixel.x)));
  }
};

TEST(ViewLayers, HaveDifferentNamesAndKeys) {
  std::set<std::string> names;
  std::set<char> keys;
  std::size_t with_key = 0;
  for (const ViewLayer& layer : viewLayers()) {
    names.insert(layer.name);
    if (layer.key != 0) ++with_key;
    if (layer.key != 0) keys.insert(layer.key);
    EXPECT_EQ(ViewLayers().*layer.is_shown, layer.is_shown_first) << layer.name;
  }
  EXPECT_EQ(names.size(), viewLayers().size());
  EXPECT_EQ(keys.size(), with_key);
}

TEST(ViewLayers, ShowEitherDensityOrVisits) {
  ViewLayers layers;
  const auto switch_on = [&](bool ViewLayers::*which) {
    for (const ViewLayer& layer : viewLayers()) {
      if (layer.is_shown == which) setShown(layers, layer, true);
    }
  };
  switch_on(&ViewLayers::density);
  switch_on(&ViewLayers::visits);
  EXPECT_FALSE(layers.density);
  switch_on(&ViewLayers::density);
  EXPECT_TRUE(layers.density);
  EXPECT_FALSE(layers.visits);
}

TEST_F(ViewLayersTest, LeaveAllButTheSelectedRobotsOutOfAView) {
  layers.sensors = false;
  Panes panes(world, fleet, {makePane(false, std::nullopt, world)}, {});
  panes.resize(camera.width_px, camera.height_px);
  panes.layers() = layers;
  const cv::Mat both = panes.draw(snapshot, paths);
  const mrpt::math::TPoint2D ann(4.8, 2.5), bob(8, 3.8), path_of_ann(4, 2.5), path_of_bob(7, 4);
  for (const auto& place : {ann, bob, path_of_ann, path_of_bob}) EXPECT_FALSE(isFloor(at(both, place))) << place.x;
  panes.layers().only = {0, 1};
  const cv::Mat of_bob = panes.draw(snapshot, paths);
  for (const auto& place : {ann, path_of_ann}) EXPECT_TRUE(isFloor(at(of_bob, place))) << place.x;
  for (const auto& place : {bob, path_of_bob}) EXPECT_EQ(at(of_bob, place), at(both, place)) << place.x;
}

TEST_F(ViewLayersTest, RequestTheReadingsOfTheSelectedRobots) {
  Panes panes(world, fleet, {makePane(false, std::nullopt, world)}, {});
  EXPECT_TRUE(panes.requestedReadings().empty()) << "of all, as there are few";
  panes.layers().only = {0, 1};
  EXPECT_EQ(panes.requestedReadings(), (std::vector<std::uint8_t>{0, 1}));
}

TEST_F(ViewLayersTest, ClickOnlyRobotsThatAreShown) {
  Panes panes(world, fleet, {makePane(false, std::nullopt, world)}, {});
  panes.resize(camera.width_px, camera.height_px);
  panes.layers().only = {0, 1};
  panes.followNext(snapshot);
  EXPECT_EQ(panes.requestedReadings(), (std::vector<std::uint8_t>{0, 1})) << "Bob, not Ann";
}

TEST_F(ViewLayersTest, HideARobotFrom3dPanes) {
  std::vector<mrpt::math::TPose2D> seen;
  const auto draw_3d = [&](const CameraInfo& info, const mrpt::math::TPose3D&, const SeenWorld& world_seen,
                           DepthBuffer*) {
    seen.assign(world_seen.world_from_robot.begin(), world_seen.world_from_robot.end());
    return cv::Mat(static_cast<int>(info.height_px), static_cast<int>(info.width_px), CV_8UC3);
  };
  Panes panes(world, fleet, {makePane(true, std::nullopt, world)}, draw_3d);
  panes.resize(400, 300);
  panes.layers().only = {1, 0};
  panes.draw(snapshot, paths);
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0].x, 5);
  EXPECT_TRUE(std::isnan(seen[1].x));
}

TEST_F(ViewLayersTest, LeaveAllButTheSelectedRobotsOutOfAFigure) {
  layers.only = {1, 0};
  const DrawnRun run = drawn();
  EXPECT_TRUE(run.world_from_robot[0]);
  EXPECT_FALSE(run.world_from_robot[1]);
  EXPECT_EQ(run.paths[0].size(), run.path_times_s[0].size());
  EXPECT_FALSE(run.paths[0].empty());
  EXPECT_TRUE(run.paths[1].empty());
  EXPECT_EQ(run.sensed.size(), 1u);
}

TEST_F(ViewLayersTest, LeaveTheRingsAtStartsOutOfAFigure) {
  layers.sensors = false;
  EXPECT_EQ(inFigure(figure(), {3, 2.5}), kFloor) << "the middle of the ring at Ann's start";
  layers.starts = false;
  const cv::Vec3b path = inFigure(figure(), {3.2, 2.5});
  EXPECT_FALSE(isFloor(path));
  EXPECT_EQ(inFigure(figure(), {3.02, 2.5}), path) << "the path begins there";
}

TEST_F(ViewLayersTest, CountVisitsOfPathsThatAreHidden) {
  DrawnRun run = drawn();
  layers.visits = true;
  layers.paths = false;
  applyLayers(run, layers, world, fleet);
  EXPECT_TRUE(run.paths.empty());
  ASSERT_TRUE(run.density);
  // Ann has driven from x = 3 to 5 at y = 2.5, in cells of 1 m.
  EXPECT_EQ(run.density->perSquareMetre(3, 2), 1);
  EXPECT_EQ(run.density->perSquareMetre(4, 2), 1);
  EXPECT_EQ(run.density->perSquareMetre(2, 2), 0);
}

}  // namespace
}  // namespace robosim
