// Pictures of many robots: marks, paths and areas measured by sensors do not cover the plane.
#include "rendering/detail_level.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "rendering/air_overlay.h"
#include "rendering/air_view.h"
#include "rendering/path_fading.h"
#include "rendering/run_figure.h"
#include "rendering/snapshot_run.h"
#include "rendering/top_view.h"
#include "robots/robot_colors.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// 40 × 25 robots of 0.2 m, 1 m apart, on a floor of 40 m × 25 m. Each has driven 0.8 m to the east, and its sonar has
/// measured a sector of 3 m.
struct Swarm {
  World world;
  Fleet fleet;
  RunSnapshot snapshot;
  RunPaths paths;

  Swarm() {
    world.name = "swarm";
    world.bounds = {0, 40, 0, 25};
    SensorInfo sonar;
    sonar.kind = SensorKind::sonar;
    sonar.range_max_m = sonar.no_echo_m = 3;
    sonar.beam_width_rad = 0.6;
    sonar.beams = {{{0.2, 0, 0.2, 0, 0, 0}}};
    const auto sensors = std::make_shared<const std::vector<SensorInfo>>(std::vector<SensorInfo>{sonar});
    for (int i = 0; i < 1000; ++i) {
      FleetRobot robot;
      robot.info.name = "Robot" + std::to_string(i);
      robot.info.radius_m = 0.2;
      robot.info.sensors = sensors;
      robot.color = paletteColor(fleet.robots.size());
      fleet.robots.push_back(robot);
      RobotSnapshot& one = snapshot.robots.emplace_back();
      one.readings.emplace().measurements = {Echoes{{2, {2.2F, 0, 0.2F}}}};
    }
    for (int step = 0; step < 2; ++step) {
      snapshot.step = static_cast<std::uint64_t>(step);
      snapshot.time_s = step;
      for (std::size_t i = 0; i < 1000; ++i) {
        const auto column = static_cast<double>(i % 40), row = static_cast<double>(i / 40);
        snapshot.robots[i].world_from_robot = {column + 0.1 + 0.8 * step, row + 0.5, 0};
      }
      paths.add(snapshot);
    }
  }

  cv::Mat fromAbove(const TopViewCamera& camera, const ViewLayers& layers = {}) const {
    return TopView(world, fleet).draw(snapshot, paths, camera, layers);
  }
};

/// Share of the pixels whose colours are light and grey, as of a floor with its grid.
double floorShare(const cv::Mat& picture) {
  cv::Mat floor;
  cv::inRange(picture, cv::Scalar::all(205), cv::Scalar::all(255), floor);
  return 1.0 * cv::countNonZero(floor) / static_cast<double>(picture.total());
}

TEST(DetailLevel, IsFullForFewRobotsAndForRobotsWithRoom) {
  EXPECT_FALSE(DetailLevel::of(60, 100).is_crowded);
  EXPECT_FALSE(DetailLevel::of(100, 100 * 2500).is_crowded);
  EXPECT_TRUE(DetailLevel::of(101, 100 * 2500).is_crowded);
}

TEST(DetailLevel, EnlargesManyRobotsNoMoreThanNecessary) {
  // 900 pixels each: π r² = 0.12 · 900 gives r = 5.9, more than 1.5, which is seen. 40 pixels: r = 1.24. 10: r = 0.6.
  EXPECT_EQ(DetailLevel::of(1000, 900e3).radius_min_px, 1.5);
  EXPECT_NEAR(DetailLevel::of(10000, 400e3).radius_min_px, 1.236, 0.001);
  EXPECT_EQ(DetailLevel::of(10000, 100e3).radius_min_px, 1);
  EXPECT_EQ(DetailLevel::of(10, 100).radius_min_px, 3) << "few robots";
  EXPECT_TRUE(DetailLevel::of(1000, 900e3).has_paths);
  EXPECT_FALSE(DetailLevel::of(10000, 750e3).has_paths);
}

TEST(DetailLevel, ShowsADensityMapInsteadOfManyRobots) {
  const DetailLevel many = DetailLevel::of(1000, 900e3, true), few = DetailLevel::of(10, 900e3, true);
  EXPECT_FALSE(many.has_robots);
  EXPECT_FALSE(many.has_paths);
  EXPECT_TRUE(few.has_robots);
  EXPECT_TRUE(few.has_paths);
}

TEST(DetailLevel, FadesPathsOfManyRobotsWithAge) {
  const auto parts = trailParts(0, 20, 0.35F);
  EXPECT_EQ(parts.front().from_s, 0);
  EXPECT_FLOAT_EQ(parts.front().paleness, 0.92F);
  EXPECT_EQ(parts.back().from_s, 16);
  EXPECT_EQ(parts.back().to_s, 20);
  EXPECT_FLOAT_EQ(parts.back().paleness, 0.35F);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    EXPECT_EQ(parts[i].from_s, parts[i - 1].to_s);
    EXPECT_LT(parts[i].paleness, parts[i - 1].paleness);
  }
}

/// Darkness of the path of robot 500 at a place along it.
double darknessAt(const cv::Mat& picture, const GroundView& view, double x_m) {
  const TPoint2D pixel = view.toPixel({x_m, 12.5});
  const auto& seen =
      picture.at<cv::Vec3b>(static_cast<int>(std::lround(pixel.y)), static_cast<int>(std::lround(pixel.x)));
  return 3 * 255.0 - seen[0] - seen[1] - seen[2];
}

TEST(DetailLevel, DrawsNewerPartsOfPathsOfManyRobotsDarkerAndOldOnesNot) {
  Swarm swarm;
  const auto drawn = [&](double time_s) {
    // Robot 500, in column 20, has driven from 20.1 to 20.9 within the second before step 1, and then stands.
    swarm.snapshot.step = 1;
    swarm.snapshot.time_s = time_s;
    const TopViewCamera camera = TopViewCamera::showing(swarm.world.bounds, 848, 548);
    return darknessAt(swarm.fromAbove(camera), TopView::groundView(swarm.snapshot, camera), 20.3);
  };
  const double new_one = drawn(1), old_one = drawn(15), gone = drawn(30);
  EXPECT_GT(new_one, 1.5 * old_one);
  EXPECT_GT(old_one, 10);
  EXPECT_LT(gone, 10) << "the floor";
}

TEST(DetailLevel, LeavesTheFloorOfATopViewVisible) {
  const Swarm swarm;
  // 400 and 64 pixels for each robot.
  EXPECT_GT(floorShare(swarm.fromAbove(TopViewCamera::showing(swarm.world.bounds, 848, 548))), 0.7);
  EXPECT_GT(floorShare(swarm.fromAbove(TopViewCamera::showing(swarm.world.bounds, 368, 248))), 0.75);
}

TEST(DetailLevel, DrawsEveryRobotOfATopViewInItsColour) {
  const Swarm swarm;
  const TopViewCamera camera = TopViewCamera::showing(swarm.world.bounds, 848, 548);
  const cv::Mat picture = swarm.fromAbove(camera);
  const GroundView view = TopView::groundView(swarm.snapshot, camera);
  for (std::size_t i = 0; i < swarm.snapshot.robots.size(); i += 37) {
    const auto& pose = swarm.snapshot.robots[i].world_from_robot;
    const TPoint2D pixel = view.toPixel({pose.x, pose.y});
    const auto& seen =
        picture.at<cv::Vec3b>(static_cast<int>(std::lround(pixel.y)), static_cast<int>(std::lround(pixel.x)));
    const Color color = swarm.fleet.robots[i].color;
    EXPECT_NEAR(seen[2], 255 * 0.8 * static_cast<double>(color[0]), 40) << i;
    EXPECT_NEAR(seen[0], 255 * 0.8 * static_cast<double>(color[2]), 40) << i;
  }
}

TEST(DetailLevel, ShowsSensorsAndFullRobotsOnceZoomedIn) {
  const Swarm swarm;
  TopViewCamera camera = TopViewCamera::showing({10, 14, 10, 13}, 848, 648);
  const cv::Mat picture = swarm.fromAbove(camera, {.names = false});
  cv::Mat tinted;  // bluish, as the area that a sonar has measured
  cv::inRange(picture, cv::Scalar(240, 220, 190), cv::Scalar(255, 235, 225), tinted);
  EXPECT_GT(cv::countNonZero(tinted), 2000);
}

TEST(DetailLevel, ShowsTheSensorsOfTheFollowedRobotAmongMany) {
  const Swarm swarm;
  TopViewCamera camera = TopViewCamera::showing(swarm.world.bounds, 848, 548);
  camera.follow = 500;
  camera.center = {20.9, 12.5};  // of robot 500, in column 20 and row 12
  TopViewCamera centered = camera;
  centered.follow.reset();
  cv::Mat difference;
  cv::absdiff(swarm.fromAbove(camera), swarm.fromAbove(centered), difference);
  EXPECT_GT(cv::norm(difference, cv::NORM_INF), 20) << "the echo";
}

TEST(DetailLevel, LeavesStartRingsSensorsAndRimsOutOfAFigure) {
  const Swarm swarm;
  const DrawnRun run = drawnRun(swarm.fleet, swarm.snapshot, swarm.paths, {});
  ASSERT_FALSE(run.sensed.empty());
  const std::string png = runFigure(PictureFormat::png, swarm.world, swarm.fleet, run);
  const cv::Mat picture =
      cv::imdecode(cv::Mat(1, static_cast<int>(png.size()), CV_8U, const_cast<char*>(png.data())), cv::IMREAD_COLOR);
  EXPECT_GT(floorShare(picture), 0.7);
  const DrawnRun few = reduced(swarm.world, run, 100);
  EXPECT_FALSE(few.sensed.empty()) << "with 10,000 pixels for each robot";
  const DrawnRun many = reduced(swarm.world, run, 15);
  EXPECT_TRUE(many.sensed.empty());
  EXPECT_FALSE(many.has_starts);
  EXPECT_FALSE(many.paths.empty());
  EXPECT_TRUE(reduced(swarm.world, run, 8).paths.empty()) << "with 64 pixels for each robot";
}

TEST(DetailLevel, DotsOfA3dPictureLieOnThePathsAndLeaveTheFloorVisible) {
  Swarm swarm;
  for (auto& robot : swarm.fleet.robots)
    robot.info.radius_m = 0.05;  // a pixel; larger robots are visible without a dot
  cv::Mat picture(480, 800, CV_8UC3, cv::Scalar::all(255));
  const DepthBuffer sky{800, 480, std::vector<float>(800UL * 480, 1)};
  const CameraInfo camera{.width_px = 800, .height_px = 480, .field_of_view_rad = 0.9, .rate_hz = 1};
  const AirPicture air{picture, sky, camera, {20, -25, 30, M_PI / 2, 0.75, 0}};
  drawAirOverlay(air, swarm.snapshot, swarm.fleet, swarm.paths, {}, {});
  EXPECT_GT(floorShare(picture), 0.75);
  const AirView view(air);
  const double top_m = swarm.fleet.robots[500].body().heights().z_max_m;
  const TPoint2D pixel = view.pixel(view.seen({20.9, 12.5, top_m}));
  const Color color = swarm.fleet.robots[500].color;
  const auto& seen =
      picture.at<cv::Vec3b>(static_cast<int>(std::lround(pixel.y)), static_cast<int>(std::lround(pixel.x)));
  EXPECT_NEAR(seen[2], 255 * static_cast<double>(color[0]), 60);
  EXPECT_NEAR(seen[0], 255 * static_cast<double>(color[2]), 60);
}

TEST(RunEvents, AreWhereAStallBeginsAndGoldIsFoundFirst) {
  RunEvents events;
  events.addState(0, true, false, TPoint2D(1, 0), 0.1);
  events.addState(0, true, false, TPoint2D(1, 1), 0.2);
  events.addState(0, false, false, TPoint2D(1, 2), 0.3);
  events.addState(0, true, true, TPoint2D(1, 3), 0.4);
  events.addState(0, false, true, TPoint2D(1, 4), 0.5);
  ASSERT_EQ(events.all().size(), 3u);
  EXPECT_EQ(events.all()[0].event.kind, RunEvent::Kind::stall);
  EXPECT_EQ(events.all()[0].event.at, TPoint2D(1, 0));
  EXPECT_EQ(events.all()[1].event.kind, RunEvent::Kind::gold);
  EXPECT_EQ(events.all()[1].time_s, 0.4);
  EXPECT_EQ(events.all()[2].event.at, TPoint2D(1, 3));
}

TEST(RunEvents, AreMarkedUpToTheTimeOfTheFigure) {
  Fleet fleet;
  fleet.robots.resize(1);
  fleet.robots[0].info.name = "Ann";
  fleet.robots[0].info.sensors = std::make_shared<const std::vector<SensorInfo>>();
  RunSnapshot snapshot;
  snapshot.robots.resize(1);
  RunEvents events;
  for (const double time_s : {1.0, 2.0, 3.0}) {
    snapshot.time_s = time_s;
    snapshot.robots[0].stalled = time_s != 2;
    addEvents(events, fleet, snapshot);
  }
  snapshot.time_s = 2.5;
  EXPECT_EQ(drawnRun(fleet, snapshot, RunPaths(), {}, &events).events.size(), 1u);
  EXPECT_EQ(drawnRun(fleet, snapshot, RunPaths(), {.paths_from_s = 1.5}, &events).events.size(), 0u);
  EXPECT_EQ(drawnRun(fleet, snapshot, RunPaths(), {.events = false}, &events).events.size(), 0u);
}

}  // namespace
}  // namespace robosim
