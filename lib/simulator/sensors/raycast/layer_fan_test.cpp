#include "sensors/raycast/layer_fan.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "base/testing/vector_widths.h"
#include "geometry/testing/random_scene.h"

namespace robosim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(LayerFan, HitsWallsTopsAndTheFloor) {
  // A wall of 2 m at 4 m, and a table top of 0.5 m from 1 m to 2 m, seen from 1 m.
  const Scene scene(
      {{OrientedBox{{4.5, 0}, {1, 0}, 0.5, 5}, {0, 2}}, {OrientedBox{{1.5, 0}, {1, 0}, 0.5, 5}, {0, 0.5}}}, 0,
      {-9, 9, -9, 9});
  const std::vector<mrpt::math::TPoint2D> directions{{1, 0}, {0.8, 0.6}, {-1, 0}};
  std::vector<double> elevations;
  for (const double slope : {-2.0, -0.4, -0.2, 0.0, 0.2, 1.0}) elevations.push_back(std::atan(slope));
  const LayerFan fan(directions, elevations, 10);
  std::vector<double> m(fan.columns() * fan.layers());
  fan.cast(scene, {0, 0, 1, 1, 0}, kNoBody, m);
  const auto at = [&](std::size_t column, std::size_t layer) { return m[fan.beam(column, layer)]; };
  EXPECT_NEAR(at(0, 0), std::hypot(0.5, 1), 1e-12) << "the floor before the table";
  EXPECT_NEAR(at(0, 1), std::hypot(1.25, 0.5), 1e-12) << "the table's top";
  EXPECT_NEAR(at(0, 2), std::hypot(4, 0.8), 1e-12) << "the wall";
  EXPECT_NEAR(at(0, 3), 4, 1e-12);
  EXPECT_NEAR(at(0, 4), std::hypot(4, 0.8), 1e-12);
  EXPECT_EQ(at(0, 5), kInfinity) << "above the wall";
  EXPECT_NEAR(at(1, 3), 5, 1e-12);
  EXPECT_NEAR(at(2, 2), std::hypot(5, 1), 1e-12) << "the floor behind";
  EXPECT_EQ(at(2, 3), kInfinity);
}

TEST(LayerFan, HitsWhatSingleRaysHit) {
  std::size_t hits = 0, misses = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    const SolidSpread spread;
    auto solids = randomSolids(rng, rng.below(60), spread);
    if (rng.below(2)) {
      for (auto& solid : solids) solid.heights.z_min_m = 0;
    }
    Scene scene(solids, 1, spread.area);
    scene.place(0, {Circle{{0, 0}, 0.3}, {0, 0.4}});
    scene.freeze();
    const BodyId owner = rng.below(2) ? scene.movingBody(0) : kNoBody;
    const std::size_t columns = 1 + rng.below(100);
    const double field_rad = rng.uniform(0.1, 2 * M_PI);
    std::vector<mrpt::math::TPoint2D> directions;
    for (std::size_t i = 0; i < columns; ++i) {
      const double angle = field_rad * (static_cast<double>(i) / static_cast<double>(columns) - 0.5);
      directions.emplace_back(std::cos(angle), std::sin(angle));
    }
    std::vector<double> elevations;
    const std::size_t layers = 1 + rng.below(20);
    for (std::size_t i = 0; i < layers; ++i) elevations.push_back(rng.uniform(-1.2, 1.2));
    std::sort(elevations.begin(), elevations.end());
    const double range_m = rng.below(3) ? rng.uniform(1, 20) : 1000;
    const LayerFan fan(directions, elevations, range_m);
    const auto from = randomPoint(rng, spread.area);
    const double heading = rng.uniform(-M_PI, M_PI);
    const ViewFrame frame{from.x, from.y, rng.uniform(0.05, 1.5), std::cos(heading), std::sin(heading)};
    std::vector<LayerFan::Column> moved;
    const bool is_moved = rng.below(2);
    constexpr double kSpread_m = 0.3;
    for (std::size_t i = 0; i < columns; ++i) {
      const double turn = is_moved ? 0.2 * static_cast<double>(i) / static_cast<double>(columns) : 0;
      const mrpt::math::TPoint2D& d = directions[i];
      moved.push_back(
          {is_moved ? mrpt::math::TPoint2D(rng.uniform(-0.2, 0.2), rng.uniform(-0.2, 0.2)) : mrpt::math::TPoint2D(),
           {std::cos(turn) * d.x - std::sin(turn) * d.y, std::sin(turn) * d.x + std::cos(turn) * d.y}});
    }
    std::vector<double> got(columns * layers), other(columns * layers);
    const auto cast = [&](std::vector<double>& to) {
      if (is_moved) {
        fan.castMoved(scene, frame, moved, kSpread_m, owner, to);
      } else {
        fan.cast(scene, frame, owner, to);
      }
    };
    cast(got);
    forEachVectorWidth([&](VectorWidth width) {
      cast(other);
      ASSERT_EQ(other, got) << nameOf(width);
    });
    const auto world = [&](const mrpt::math::TPoint2D& v) {
      return mrpt::math::TPoint2D(frame.ahead_x * v.x - frame.ahead_y * v.y, frame.ahead_y * v.x + frame.ahead_x * v.y);
    };
    for (std::size_t column = 0; column < columns; ++column) {
      for (std::size_t layer = 0; layer < layers; ++layer) {
        const auto origin = world(moved[column].origin);
        const auto direction = world(moved[column].direction);
        const double cos = std::cos(elevations[layer]), sin = std::sin(elevations[layer]);
        const Ray ray{{frame.x + origin.x, frame.y + origin.y, frame.z}, {direction.x * cos, direction.y * cos, sin}};
        const Hit hit = scene.castRay(ray, range_m, owner);
        const double floor_m = sin < 0 ? -frame.z / sin : kInfinity;
        const double expected = hit && hit.distance_m < floor_m ? hit.distance_m
                                : floor_m < range_m             ? floor_m
                                                                : kInfinity;
        const double found = got[fan.beam(column, layer)];
        if (expected == kInfinity) {
          ASSERT_EQ(found, kInfinity) << "seed " << seed << " column " << column << " layer " << layer;
          ++misses;
        } else {
          ASSERT_NEAR(found, expected, 1e-9) << "seed " << seed << " column " << column << " layer " << layer;
          ++hits;
        }
      }
    }
  }
  EXPECT_GT(hits, 10000U);
  EXPECT_GT(misses, 3000U);
}

}  // namespace
}  // namespace robosim
