#include "rendering/top_view.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "rendering/testing/top_view_fixture.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

TEST_F(TopViewTest, FillsThePictureToScaleWithXToTheRightAndYUp) {
  EXPECT_DOUBLE_EQ(camera.px_per_m, 100) << "1048 px without two margins of 24, over 10 m";
  const GroundView view = TopView::groundView(snapshot, camera);
  EXPECT_NEAR(view.toPixel({0, 5}).x, 23.5, 1e-9);
  EXPECT_NEAR(view.toPixel({10, 2.5}).x, 1023.5, 1e-9);
  EXPECT_NEAR(view.toPixel({5, 2.5}).y, 349.5, 1e-9);
  EXPECT_LT(view.toPixel({5, 4}).y, view.toPixel({5, 1}).y);
  const TPoint2D there_and_back = view.toWorld(view.toPixel({3, 4}));
  EXPECT_NEAR(there_and_back.x, 3, 1e-12);
  EXPECT_NEAR(there_and_back.y, 4, 1e-12);
}

TEST_F(TopViewTest, DrawsAnObjectToThePixel) {
  const cv::Mat picture = TopView(world, fleet).draw(snapshot, paths, camera, layers);
  ASSERT_EQ(picture.cols, 1048);
  ASSERT_EQ(picture.rows, 700);
  const cv::Vec3b blue(255, 0, 0);
  const cv::Vec3b floor(255, 255, 255);
  EXPECT_EQ(at(picture, {2, 1.5}), blue);
  for (const double inside : {0.95, -0.95}) EXPECT_EQ(at(picture, {2 + inside, 1.5}), blue) << inside;
  for (const double outside : {1.04, -1.04}) EXPECT_EQ(at(picture, {2 + outside, 1.65}), floor) << outside;
  EXPECT_EQ(at(picture, {2, 1.5 + 0.45}), blue);
  EXPECT_EQ(at(picture, {2.15, 1.5 + 0.55}), floor);
}

TEST_F(TopViewTest, DrawsRobotsWithAHeadingMark) {
  const cv::Mat picture = TopView(world, fleet).draw(snapshot, paths, camera, layers);
  const cv::Vec3b red = at(picture, {5 - 0.3, 2.5});
  EXPECT_GT(red[2], 2 * red[0]) << "the first robot is red";
  EXPECT_EQ(at(picture, {5 + 0.3, 2.5}), cv::Vec3b(255, 255, 255)) << "a white heading mark";
  EXPECT_EQ(at(picture, {8, 4 + 0.3}), cv::Vec3b(255, 255, 255)) << "the other robot faces north";
  EXPECT_NE(at(picture, {8 + 0.3, 4}), cv::Vec3b(255, 255, 255));
}

TEST_F(TopViewTest, DrawsTheLedsOfARobotAsADiscOfTheirColour) {
  snapshot.robots[0].led_color = 0x00ff00;
  const cv::Mat picture = TopView(world, fleet).draw(snapshot, paths, camera, layers);
  EXPECT_EQ(at(picture, {5, 2.5 + 0.1}), cv::Vec3b(0, 255, 0));
  EXPECT_GT(at(picture, {5 - 0.3, 2.5})[2], 100) << "around it, the robot is red";
}

TEST_F(TopViewTest, DrawsNoAbsentRobot) {
  snapshot.robots[0].activity = Activity::absent;
  Readings readings;
  readings.measurements = {Echoes{{2, {2.5F, 0, 0.2F}}}};
  snapshot.robots[0].readings = readings;
  const cv::Mat picture = TopView(world, fleet).draw(snapshot, paths, camera, layers);
  const cv::Vec3b floor = at(picture, {4.53, 1.53});
  EXPECT_EQ(at(picture, {5 - 0.3, 2.53}), floor);
  EXPECT_EQ(at(picture, {5 + 0.5 + 1.03, 2.53}), floor);
  EXPECT_EQ(TopView::robotAt(TopView::groundView(snapshot, camera).toPixel({5, 2.5}), snapshot, fleet, camera),
            std::nullopt);
}

TEST_F(TopViewTest, TintsTheFreeSectorOfASonarAndMarksItsEcho) {
  Readings readings;
  readings.measurements = {Echoes{{2, {2.5F, 0, 0.2F}}}};
  snapshot.robots[0].readings = readings;
  const cv::Mat picture = TopView(world, fleet).draw(snapshot, paths, camera, layers);
  const auto is_tinted = [&](const TPoint2D& p) {
    const cv::Vec3b pixel = at(picture, p);
    return pixel[0] > pixel[2] + 10;  // bluish
  };
  EXPECT_TRUE(is_tinted({5 + 0.5 + 1.03, 2.53})) << "half way, beside the grid's lines";
  EXPECT_TRUE(is_tinted({5 + 0.5 + 1.5, 2.5 + 0.25})) << "within 0.2 rad";
  EXPECT_FALSE(is_tinted({5 + 0.5 + 1.53, 2.5 + 0.42})) << "beyond 0.2 rad";
  EXPECT_FALSE(is_tinted({5 + 0.5 + 2.23, 2.53})) << "beyond the echo";
  const cv::Vec3b dot = at(picture, {7.5, 2.5});
  EXPECT_LT(dot[2], 100) << "a dot at the echo";
  layers.sensors = false;
  EXPECT_FALSE([&] {
    const cv::Vec3b pixel = at(TopView(world, fleet).draw(snapshot, paths, camera, layers), {6.53, 2.53});
    return pixel[0] > pixel[2] + 10;
  }());
}

TEST_F(TopViewTest, TurnsTheFreeSectorOfAPanningSensor) {
  auto sensors = *fleet.robots[0].info.sensors;
  sensors[0].pans = true;
  fleet.robots[0].info.sensors = std::make_shared<const std::vector<SensorInfo>>(sensors);
  Readings readings;
  readings.measurements = {Echoes{{2, {0.5F, 2, 0.2F}}}};
  snapshot.robots[0].readings = readings;
  snapshot.robots[0].laser_pan_rad = static_cast<float>(std::numbers::pi / 2);
  const cv::Mat picture = TopView(world, fleet).draw(snapshot, paths, camera, layers);
  const auto is_tinted = [&](const TPoint2D& p) {
    const cv::Vec3b pixel = at(picture, p);
    return pixel[0] > pixel[2] + 10;  // bluish
  };
  EXPECT_TRUE(is_tinted({5 + 0.53, 2.5 + 1.03})) << "to the left of the robot";
  EXPECT_FALSE(is_tinted({5 + 0.5 + 1.03, 2.53})) << "ahead";
}

TEST_F(TopViewTest, DrawsTheWorldWhereItIsAfterTheViewHasMoved) {
  // From the second picture of a view on, the world is drawn from layers.
  const auto second_picture_of = [&](TopView& view) {
    view.draw(snapshot, paths, camera, layers);
    return view.draw(snapshot, paths, camera, layers);
  };
  TopView moved(world, fleet), other(world, fleet);
  second_picture_of(moved);
  camera.center.x += 1;
  EXPECT_EQ(cv::norm(second_picture_of(moved), second_picture_of(other), cv::NORM_INF), 0);
}

TEST_F(TopViewTest, TintsTheFreeAreaOfAScanAndMarksItsEchoes) {
  // To the left, ahead and to the right of the laser; the middle beam has no echo.
  SensorInfo laser;
  laser.kind = SensorKind::laser;
  laser.range_max_m = laser.no_echo_m = 1;
  for (const double yaw : {std::numbers::pi / 2, 0.0, -std::numbers::pi / 2})
    laser.beams.push_back({{0, 0, 0.2, yaw, 0, 0}});
  fleet.robots[0].info.sensors = std::make_shared<const std::vector<SensorInfo>>(std::vector<SensorInfo>{laser});
  snapshot.robots[0].readings.emplace();
  snapshot.robots[0].readings->measurements = {Echoes{{0.9F, {0, 0.9F, 0}}, {1, {1, 0, 0}}, {0.9F, {0, -0.9F, 0}}}};
  const cv::Mat picture = TopView(world, fleet).draw(snapshot, paths, camera, layers);
  const auto is_tinted = [&](const TPoint2D& p) {
    const cv::Vec3b pixel = at(picture, p);
    return pixel[2] > pixel[0] + 10;  // reddish
  };
  // A triangle from (5, 3.4) to (6, 2.5) to (5, 1.6), behind the robot of 0.5 m.
  EXPECT_TRUE(is_tinted({5.53, 2.53 + 0.3}));
  EXPECT_FALSE(is_tinted({5.53, 2.53 + 0.55})) << "beyond the line between two echoes";
  EXPECT_FALSE(is_tinted({4.93, 2.53 + 0.6})) << "behind the laser";
  const cv::Vec3b dot = at(picture, {5, 3.4});
  EXPECT_GT(dot[2], dot[0] + 100) << "a dot at the echo";
  const cv::Vec3b tip = at(picture, {6, 2.5});
  EXPECT_LT(tip[2], tip[0] + 100) << "no dot without an echo";
}

TEST_F(TopViewTest, AcceptsASensorWithoutMeasurement) {
  snapshot.robots[0].readings.emplace();
  snapshot.robots[0].readings->measurements = {Echoes{}};
  const cv::Mat silent = TopView(world, fleet).draw(snapshot, paths, camera, layers);
  snapshot.robots[0].readings.reset();
  const cv::Mat without = TopView(world, fleet).draw(snapshot, paths, camera, layers);
  EXPECT_EQ(cv::norm(silent, without, cv::NORM_INF), 0);
}

TEST_F(TopViewTest, WritesTheHeatBesideARobot) {
  SensorInfo heat;
  heat.kind = SensorKind::heat;
  fleet.robots[0].info.sensors = std::make_shared<const std::vector<SensorInfo>>(std::vector<SensorInfo>{heat});
  const auto picture_at = [&](double heat_now) {
    snapshot.robots[0].readings.emplace();
    snapshot.robots[0].readings->measurements = {Scalar{heat_now}};
    return TopView(world, fleet).draw(snapshot, paths, camera, layers);
  };
  const cv::Mat cold = picture_at(0), warm = picture_at(7), hot = picture_at(40);
  // Below and to the right of the robot, "heat 7" and "heat 40" at 11 px or so, and nowhere else.
  const cv::Rect beside(523 + 38, 349 + 32, 80, 24);
  const auto ink_of = [&](const cv::Mat& picture, const cv::Rect& part) {
    cv::Mat difference;
    cv::absdiff(picture(part), cold(part), difference);
    return cv::sum(difference)[0];
  };
  const cv::Rect all(0, 0, 1048, 700);
  EXPECT_GT(ink_of(warm, beside), 1000);
  EXPECT_EQ(ink_of(warm, beside), ink_of(warm, all));
  EXPECT_GT(ink_of(hot, beside), ink_of(warm, beside)) << "two digits";
}

TEST_F(TopViewTest, DrawsPaths) {
  RunSnapshot before = snapshot;
  for (int i = 0; i <= 20; ++i) {
    before.step = static_cast<std::uint64_t>(i);
    before.robots[0].world_from_robot = {3 + 0.1 * i, 3.53, 0};
    paths.add(before);
  }
  snapshot.robots[0].world_from_robot = {5, 3.53, 0};
  const cv::Vec3b on_path = at(TopView(world, fleet).draw(snapshot, paths, camera, layers), {3.75, 3.53});
  EXPECT_GT(on_path[2], on_path[0] + 40) << "reddish, like the robot";
}

TEST_F(TopViewTest, PathsHaveGapsAfterSkippedSteps) {
  RunSnapshot before = snapshot;
  const auto come_to = [&](std::uint64_t step, double x) {
    before.step = step;
    before.robots[0].world_from_robot = {x, 3.53, 0};
    paths.add(before);
  };
  come_to(0, 1);
  come_to(50, 1.9);  // short enough for a straight line
  come_to(100, 4);   // seek
  come_to(101, 6);   // fast run
  snapshot.robots[0].world_from_robot = {6, 3.53, 0};
  const cv::Mat picture = TopView(world, fleet).draw(snapshot, paths, camera, layers);
  const auto is_red = [&](double x) {
    const cv::Vec3b pixel = at(picture, {x, 3.53});
    return pixel[2] > pixel[0] + 40;
  };
  EXPECT_TRUE(is_red(1.45));
  EXPECT_FALSE(is_red(2.95));
  EXPECT_TRUE(is_red(4.95));
}

TEST_F(TopViewTest, DrawsRobotsInTheColoursOfTheirBodies) {
  const auto color_of = [&](double x, double y) {
    return at(TopView(world, fleet).draw(snapshot, paths, camera, layers), {x, y});
  };
  fleet.robots[0].color = {0, 1, 0};
  fleet.robots[1].color = {0, 0, 1};
  const cv::Vec3b green = color_of(4.75, 2.5), blue = color_of(8, 3.75);
  EXPECT_GT(green[1], green[2] + 100);
  EXPECT_GT(blue[0], blue[2] + 100);
  fleet.robots[1].color = {0, 1, 0};
  EXPECT_EQ(color_of(4.75, 2.5), color_of(8, 3.75)) << "a team";
}

TEST_F(TopViewTest, FadesOldPathsWhereTheyCoverThePicture) {
  RunSnapshot before = snapshot;
  const auto ride = [&](int lines) {  // boustrophedon, 0.1 s per metre
    for (int i = 0; i < lines; ++i) {
      for (const double x : {0.5, 9.5}) {
        ++before.step;
        before.time_s += 1;
        before.robots[0].world_from_robot = {i % 2 == 0 ? x : 10 - x, 1 + 0.02 * i, 0};
        paths.add(before);
      }
    }
    return at(TopView(world, fleet).draw(before, paths, camera, layers), {5, 1});
  };
  snapshot.robots[0].world_from_robot = {9.5, 4.5, 0};
  const cv::Vec3b few = ride(12);
  const cv::Vec3b many = ride(100);
  EXPECT_GT(few[2], few[0] + 60) << "red";
  EXPECT_GT(many[0], few[0] + 40) << "pale";
  EXPECT_GT(many[2], many[0] + 8) << "but visible";
}

TEST_F(TopViewTest, KeepsAFollowedRobotInTheMiddle) {
  camera.follow = 1;
  const TPoint2D pixel = TopView::groundView(snapshot, camera).toPixel({8, 4});
  EXPECT_NEAR(pixel.x, 523.5, 1e-9);
  EXPECT_NEAR(pixel.y, 349.5, 1e-9);
}

TEST_F(TopViewTest, ZoomingKeepsThePointUnderThePointer) {
  const TPoint2D pixel(200, 600);
  const TPoint2D before = TopView::groundView(snapshot, camera).toWorld(pixel);
  camera.zoom(2.5, pixel);
  EXPECT_DOUBLE_EQ(camera.px_per_m, 250);
  const TPoint2D after = TopView::groundView(snapshot, camera).toWorld(pixel);
  EXPECT_NEAR(after.x, before.x, 1e-9);
  EXPECT_NEAR(after.y, before.y, 1e-9);
}

TEST_F(TopViewTest, FindsTheRobotAtAPixel) {
  const GroundView view = TopView::groundView(snapshot, camera);
  EXPECT_EQ(TopView::robotAt(view.toPixel({8.3, 4.2}), snapshot, fleet, camera), 1U);
  EXPECT_EQ(TopView::robotAt(view.toPixel({8.6, 4}), snapshot, fleet, camera), std::nullopt);
}

}  // namespace
}  // namespace robosim
