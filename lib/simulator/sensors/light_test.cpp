#include "sensors/light.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/random.h"
#include "sensors/testing/featured_scene.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

constexpr const char* kRing = "<light><ring count='4' radius_m='0.1' z_m='0.1'/></light>";

TEST(Light, FollowsTheInverseSquareAndTheCosine) {
  const auto sensor = sensorFrom(kRing);
  FeaturedScene scene;
  scene.objects = {lampAt({2.1, 0, 0.1}, 8)};
  auto lux = scene.values(*sensor);
  ASSERT_EQ(lux.size(), 4u);
  EXPECT_NEAR(lux[0], 2, 1e-6) << "8 cd at 2 m, straight ahead";
  EXPECT_EQ(lux[1], 0) << "slightly behind the axis to the left";
  EXPECT_EQ(lux[2], 0);
  EXPECT_EQ(lux[3], 0);
  scene.objects = {lampAt({3.1, 4, 0.1}, 50)};
  lux = scene.values(*sensor);
  EXPECT_NEAR(lux[0], 50.0 / 25 * 3 / 5, 1e-6) << "5 m away, 3 m along the axis";
  scene.objects = {lampAt({0, 0.1, 2.1}, 50)};
  EXPECT_NEAR(scene.values(*sensor)[1], 0, 1e-6) << "straight above";
  EXPECT_EQ(sensor->info().quantities[0].unit, "lx");
}

TEST(Light, AddsAllLightsThatNothingHidesWithinItsRange) {
  const auto sensor = sensorFrom("<light range_max_m='5'><at x_m='0.1' z_m='0.1'/></light>");
  FeaturedScene scene;
  scene.objects = {lampAt({1.1, 0, 0.1}, 3), lampAt({2.1, 0.5, 0.5}, 0), lampAt({5.2, 0, 0.1}, 1000)};
  EXPECT_NEAR(scene.values(*sensor)[0], 3, 1e-6) << "one is off, one is too far away";
  scene.objects.push_back(lampAt({3.1, 0, 4.1}, 25));
  EXPECT_NEAR(scene.values(*sensor)[0], 3 + 25.0 / 25 * 3 / 5, 1e-6);
  scene.objects.push_back(boxBody({0.5, 0, 0}, 0.1, 1, 0, 0.3));
  EXPECT_NEAR(scene.values(*sensor)[0], 0.6, 1e-6) << "the lower one is behind a low wall";
  scene.robots.emplace_back(0.5, 5, 0);
  EXPECT_NEAR(scene.values(*sensor)[0], 0.6, 1e-6);
  scene.objects.pop_back();
  scene.robots[1] = {0.6, 0, 0};
  EXPECT_NEAR(scene.values(*sensor)[0], 0.6, 1e-6) << "another robot casts a shadow";
}

TEST(Light, IsLimitedNearALightAndByItsLargestReading) {
  FeaturedScene scene;
  scene.objects = {lampAt({0.105, 0, 0.1}, 1)};
  EXPECT_NEAR(scene.values(*sensorFrom("<light><at x_m='0.1' z_m='0.1'/></light>"))[0], 1e4, 1e-2) << "1 cm";
  EXPECT_EQ(scene.values(*sensorFrom("<light max_lx='500'><at x_m='0.1' z_m='0.1'/></light>"))[0], 500);
}

TEST(Light, ReadsWhatASearchOfAllObjectsFinds) {
  Rng rng(5);
  const auto sensor = sensorFrom("<light><ring count='6' radius_m='0.1' z_m='0.2'/></light>");
  int shadows = 0, lit = 0;
  for (int round = 0; round < 200; ++round) {
    FeaturedScene scene;
    scene.robots = {{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-3, 3)}, {2, 0, 0}, {-2, 1, 0}};
    for (int i = 0; i < 4; ++i) {
      const double direction = rng.uniform(-3, 3), distance_m = rng.uniform(1.5, 4);
      scene.objects.push_back(boxBody({distance_m * std::cos(direction), distance_m * std::sin(direction), direction},
                                      rng.uniform(0.1, 0.4), rng.uniform(0.1, 1.5), 0, rng.uniform(0.2, 1)));
    }
    for (int i = 0; i < 3; ++i)
      scene.objects.push_back(
          lampAt({rng.uniform(-6, 6), rng.uniform(-6, 6), rng.uniform(0.1, 2)}, rng.uniform(1, 50)));
    const auto measured = scene.values(*sensor);
    for (int i = 0; i < 6; ++i) {
      const double direction = scene.robots[0].phi + 2 * M_PI * i / 6;
      const mrpt::math::TPoint3D axis(std::cos(direction), std::sin(direction), 0);
      const mrpt::math::TPoint3D from(scene.robots[0].x + 0.1 * axis.x, scene.robots[0].y + 0.1 * axis.y, 0.2);
      double expected = 0;
      for (const Body& lamp : scene.objects) {
        const mrpt::math::TPoint3D to(lamp.world_from_body.x, lamp.world_from_body.y, lamp.center_z_m);
        const auto way = to - from;
        const double cosine = (way.x * axis.x + way.y * axis.y) / way.norm();
        if (lamp.light_cd == 0 || cosine <= 0) continue;
        const bool is_free = isFreeByHand(scene, from, to, &lamp);
        (is_free ? lit : shadows) += 1;
        if (is_free) expected += lamp.light_cd * cosine / std::pow(way.norm(), 2);
      }
      EXPECT_NEAR(measured[static_cast<std::size_t>(i)], expected, 1e-5 * (1 + expected)) << round << ", " << i;
    }
  }
  EXPECT_GT(shadows, 100);
  EXPECT_GT(lit, 100);
}

TEST(Light, NoiseHasTheGivenDeviation) {
  const auto sensor = sensorFrom("<light><at z_m='0.1'/><noise std_share='0.1' std_lx='0.2'/></light>");
  EXPECT_TRUE(sensor->isNoisy());
  FeaturedScene scene;
  scene.objects = {lampAt({1, 0, 0.1}, 8)};
  constexpr int kSamples = 4000;
  double squares = 0;
  for (int i = 0; i < kSamples; ++i) {
    ++scene.step;
    squares += std::pow(scene.values(*sensor)[0] - 8, 2);
  }
  EXPECT_NEAR(std::sqrt(squares / kSamples), 1, 4.0 / 89) << "a tenth of 8 lx, and 0.2 lx";
}

TEST(Light, NeedsAPlace) { EXPECT_THROW(sensorFrom("<light/>"), ConfigError); }

}  // namespace
}  // namespace robosim
