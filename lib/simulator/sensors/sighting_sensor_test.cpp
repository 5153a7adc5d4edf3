// The sensors that see where things are: <omni_camera> and <fiducial>.
#include "sensors/sighting_sensor.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "base/error_list.h"
#include "base/random.h"
#include "hardware/led_color.h"
#include "sensors/testing/featured_scene.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

using Record = std::vector<double>;

std::vector<Record> recordsOf(FeaturedScene& scene, const Sensor& sensor, std::size_t size) {
  const auto values = scene.values(sensor);
  EXPECT_EQ(values.size(), sensor.info().quantities.size());
  std::vector<Record> records;
  for (std::size_t i = 0; i + size <= values.size(); i += size) {
    if (values[i] >= 0)
      records.emplace_back(values.begin() + static_cast<std::ptrdiff_t>(i),
                           values.begin() + static_cast<std::ptrdiff_t>(i + size));
  }
  return records;
}

void expectNear(const Record& measured, const Record& expected) {
  ASSERT_EQ(measured.size(), expected.size());
  EXPECT_EQ(measured[0], expected[0]);
  for (std::size_t i = 1; i < expected.size(); ++i) EXPECT_NEAR(measured[i], expected[i], 1e-6) << i;
}

Body marked(Body body, double number) {
  body.fiducial = number;
  return body;
}

TEST(OmniCamera, SeesLedsAndLightsTheNearestFirst) {
  const auto sensor = sensorFrom("<omni_camera range_max_m='5'/>");
  FeaturedScene scene;
  // The robot at (1, 2) faces left (+y). Robot 1 is 2 m ahead, robot 2, 1 m to its right, has no light.
  scene.robots = {{1, 2, M_PI / 2}, {1, 4, 0}, {2, 2, 1}};
  scene.commands = {{.led_color = 0x00ff00}, {.led_color = 0xff0000}, {}};
  scene.objects = {coloured(lampAt({0, 2, 1}, 3), {0, 0, 1}), coloured(lampAt({0.5, 2, 1}, 0), {0, 0, 1})};
  const auto seen = recordsOf(scene, *sensor, 3);
  ASSERT_EQ(seen.size(), 2u);
  expectNear(seen[0], {0x0000ff, 1, M_PI / 2});
  expectNear(seen[1], {0xff0000, 2, 0});
  EXPECT_EQ(sensor->info().quantities[3].name, "color_2");
}

TEST(OmniCamera, SeesNothingHiddenOrOutOfRange) {
  const auto sensor = sensorFrom("<omni_camera range_max_m='2.5'/>");  // as high as the robots, 0.3 m
  FeaturedScene scene;
  scene.robots = {{0, 0, 0}, {2.4, 0, 0}, {0, 2.6, 0}};
  scene.commands = {{}, {.led_color = 1}, {.led_color = 2}};
  EXPECT_EQ(recordsOf(scene, *sensor, 3).size(), 1u);
  scene.objects = {boxBody({1, 0, 0}, 0.1, 1, 0, 0.4)};
  EXPECT_TRUE(recordsOf(scene, *sensor, 3).empty());
  scene.objects = {boxBody({1, 0, 0}, 0.1, 1, 0, 0.2)};
  EXPECT_EQ(recordsOf(scene, *sensor, 3).size(), 1u) << "over a low wall";
  EXPECT_EQ(recordsOf(scene, *sensorFrom("<omni_camera z_m='0.1'/>"), 3).size(), 1u)
      << "which a low camera does not look over; the other robot is within 3 m";
}

TEST(OmniCamera, SeesNoMoreThanItsCount) {
  const auto sensor = sensorFrom("<omni_camera count='2'/>");
  FeaturedScene scene;
  scene.robots = {{0, 0, 0}, {1, 0, 0}, {0, 1.5, 0}, {-2, 0, 0}};
  scene.commands = {{}, {.led_color = 1}, {.led_color = 2}, {.led_color = 3}};
  const auto seen = recordsOf(scene, *sensor, 3);
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0][0], 1);
  EXPECT_EQ(seen[1][0], 2);
}

TEST(Fiducial, ReadsNumberPlaceAndOrientationOfMarks) {
  const auto sensor = sensorFrom("<fiducial z_m='0.2' id_range_max_m='3'/>");
  FeaturedScene scene;
  scene.robots = {{1, 2, M_PI / 2}};
  scene.objects = {marked(boxBody({1, 4, M_PI}, 0.2, 0.2, 0, 0.5), 7), marked(boxBody({4, 2, 0}, 0.2, 0.2), 12),
                   marked(boxBody({1, 5.01, 0}, 0.2, 0.2, 0.9, 1.5), 13), boxBody({0, 2, 0}, 0.2, 0.2)};
  const auto seen = recordsOf(scene, *sensor, 4);
  ASSERT_EQ(seen.size(), 3u);
  expectNear(seen[0], {7, 2, 0, M_PI / 2});
  expectNear(seen[1], {12, 3, -M_PI / 2, -M_PI / 2});
  expectNear(seen[2], {0, 3.01, 0, -M_PI / 2});  // too far to be read, and higher than the first one
}

TEST(Fiducial, SeesMarksInItsFieldOfViewFromItsPlace) {
  // At (0.5, 0) on the robot, directed to the left, 90° wide: from 45° to 135° of the robot.
  const auto sensor = sensorFrom("<fiducial x_m='0.5' angle_deg='90' field_of_view_deg='90' range_max_m='4'/>");
  FeaturedScene scene;
  const auto sees = [&](double x, double y) {
    scene.objects = {marked(pillarBody(x, y, 0.1), 1)};
    return recordsOf(scene, *sensor, 4);
  };
  const auto ahead = sees(0.5, 3);
  ASSERT_EQ(ahead.size(), 1u);
  expectNear(ahead[0], {1, 3, 0, -M_PI / 2});
  EXPECT_EQ(sees(2.4, 2).size(), 1u) << "43.5° to the right";
  EXPECT_TRUE(sees(2.6, 2).empty()) << "46.4°";
  EXPECT_TRUE(sees(0.5, -2).empty());
  EXPECT_TRUE(sees(0.5, 4.01).empty());
  EXPECT_THROW(sensorFrom("<fiducial count='65'/>"), ConfigError);
}

TEST(SightingSensor, SeesWhatASearchOfAllObjectsFinds) {
  Rng rng(7);
  const auto camera = sensorFrom("<omni_camera range_max_m='4' z_m='0.25' count='20'/>");
  const auto fiducial = sensorFrom("<fiducial range_max_m='4' z_m='0.25' count='20' field_of_view_deg='200'/>");
  std::size_t seen = 0, hidden = 0;
  for (int round = 0; round < 200; ++round) {
    FeaturedScene scene;
    scene.robots[0] = {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-3, 3)};
    for (std::uint32_t i = 1; i <= 6; ++i) {
      const double direction = 2 * M_PI * i / 6;
      scene.robots.emplace_back(2.5 * std::cos(direction), 2.5 * std::sin(direction), rng.uniform(-3, 3));
      scene.commands.push_back({.led_color = i});
    }
    for (std::uint32_t i = 0; i < 8; ++i) {
      const double direction = rng.uniform(-3, 3), distance_m = rng.uniform(1.5, 5);
      Body body = boxBody({distance_m * std::cos(direction), distance_m * std::sin(direction), direction},
                          rng.uniform(0.05, 0.3), rng.uniform(0.05, 0.8), 0, rng.uniform(0.2, 0.6));
      if (i % 2 == 0) body.light_cd = 1;
      body.fiducial = i;
      scene.objects.push_back(coloured(body, rgbOf(100 + i)));
    }
    const mrpt::math::TPoint3D from(scene.robots[0].x, scene.robots[0].y, 0.25);
    std::vector<double> colors, numbers;
    const auto look = [&](const mrpt::math::TPoint3D& to, const Body* body, std::size_t robot) {
      if (std::hypot(to.x - from.x, to.y - from.y) > 4) return false;
      const bool is_free = isFreeByHand(scene, from, to, body, robot);
      (is_free ? seen : hidden) += 1;
      return is_free;
    };
    for (std::size_t i = 1; i < scene.robots.size(); ++i) {
      if (look({scene.robots[i].x, scene.robots[i].y, 0.3}, nullptr, i)) colors.push_back(static_cast<double>(i));
    }
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      const Body& body = scene.objects[i];
      const auto& pose = body.world_from_body;
      if (!look({pose.x, pose.y, body.center_z_m}, &body, 0)) continue;
      if (body.light_cd > 0) colors.push_back(100 + static_cast<double>(i));
      const double bearing = std::atan2(pose.y - from.y, pose.x - from.x) - scene.robots[0].phi;
      if (body.fiducial > 0 && std::abs(std::remainder(bearing, 2 * M_PI)) < toRadians(100))
        numbers.push_back(body.fiducial);
    }
    const auto sorted = [](std::vector<Record> records) {
      std::vector<double> first;
      for (std::size_t i = 0; i < records.size(); ++i) {
        first.push_back(records[i][0]);
        EXPECT_TRUE(i == 0 || records[i - 1][1] <= records[i][1]);
      }
      std::sort(first.begin(), first.end());
      return first;
    };
    std::sort(colors.begin(), colors.end());
    std::sort(numbers.begin(), numbers.end());
    EXPECT_EQ(sorted(recordsOf(scene, *camera, 3)), colors) << round;
    EXPECT_EQ(sorted(recordsOf(scene, *fiducial, 4)), numbers) << round;
  }
  EXPECT_GT(seen, 500u);
  EXPECT_GT(hidden, 200u);
}

TEST(SightingSensor, NoiseHasTheGivenDeviations) {
  const auto sensor = sensorFrom("<fiducial><noise std_m='0.1' bearing_std_deg='10'/></fiducial>");
  EXPECT_TRUE(sensor->isNoisy());
  FeaturedScene scene;
  scene.objects = {marked(pillarBody(2, 0, 0.1), 1)};
  constexpr int kSamples = 4000;
  Record squares(3);
  for (int i = 0; i < kSamples; ++i) {
    ++scene.step;
    const auto seen = recordsOf(scene, *sensor, 4);
    ASSERT_EQ(seen.size(), 1u);
    const Record exact{2, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) squares[k] += std::pow(seen[0][k + 1] - exact[k], 2);
  }
  // The standard error of a deviation is 1/89 of it. Bounds are four of them.
  EXPECT_NEAR(std::sqrt(squares[0] / kSamples), 0.1, 4 * 0.1 / 89);
  for (const std::size_t k : {1u, 2u})
    EXPECT_NEAR(std::sqrt(squares[k] / kSamples), toRadians(10), 4 * toRadians(10) / 89);
}

}  // namespace
}  // namespace robosim
