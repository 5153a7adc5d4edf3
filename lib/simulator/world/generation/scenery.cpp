#include "world/generation/scenery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/error_list.h"
#include "base/portable_math.h"
#include "base/random.h"

namespace robosim {
namespace {

constexpr std::array<float, 3> kWallColor{0.55f, 0.46f, 0.37f};

/// Hues a golden angle apart, so that robots of adjacent indices differ clearly.
std::array<float, 3> pickColor(int index) {
  const double hue = std::fmod(index * 0.381966, 1) * 6;
  const double parts[] = {std::abs(hue - 3) - 1, 2 - std::abs(hue - 2), 2 - std::abs(hue - 4)};
  std::array<float, 3> color{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = 0.9 * (1 - 0.75 * (1 - std::min(1.0, std::max(0.0, parts[i]))));
    color[i] = static_cast<float>(std::round(value * 100) / 100);
  }
  return color;
}

WorldObject goldAt(const mrpt::math::TPoint2D& place) {
  WorldObject gold;
  gold.name = "Gold";
  gold.body = {.shape = Cylinder{0.2},
               .world_from_body = {place.x, place.y, 0},
               .center_z_m = 0.25,
               .height_m = 0.5,
               .color = {1, 0.8f, 0.1f},
               .heat_celsius = 20};
  return gold;
}

/// Chooses places, each as far as possible from those chosen before.
class Spread {
 public:
  Spread(const Places& places, std::uint64_t seed)
      : places_(places), steps_(places), rng_(seed, RandomPurpose::scenery, 0, 1), taken_(places.at.size(), 0) {}

  /// @return whether there was one left
  bool choose(std::vector<mrpt::math::TPoint2D>& chosen) {
    const auto count = static_cast<std::uint32_t>(places_.at.size());
    if (count == 0) return false;
    const std::uint32_t place =
        chosen.empty() ? rng_.below(count) : steps_.farthest([&](std::uint32_t i) { return !taken_[i]; });
    if (place == count) return false;
    steps_.addSource(place);
    chosen.push_back(places_.at[place]);
    // Blocks the surroundings, whose places are connected with it by short steps.
    std::vector<std::uint32_t> open{place};
    taken_[place] = 1;
    while (!open.empty()) {
      const std::uint32_t here = open.back();
      open.pop_back();
      for (const std::uint32_t near : places_.next[here]) {
        const auto apart = places_.at[near] - places_.at[place];
        if (taken_[near] == place + 2 || portable::hypot(apart.x, apart.y) >= kStartDistance_m) continue;
        taken_[near] = place + 2;
        open.push_back(near);
      }
    }
    return true;
  }
  Rng& rng() { return rng_; }

 private:
  const Places& places_;
  StepsFromSources steps_;
  Rng rng_;
  std::vector<std::uint32_t> taken_;  ///< 0: not; otherwise at or near a chosen place
};

}  // namespace

double rounded(double value) { return std::round(value * 1000) / 1000; }

WorldObject wall(const std::string& name, double center_x_m, double center_y_m, double length_m, double width_m) {
  WorldObject object;
  object.name = name;
  object.body = {.shape = Cube{length_m, width_m},
                 .world_from_body = {center_x_m, center_y_m, 0},
                 .center_z_m = kWallHeight_m / 2,
                 .height_m = kWallHeight_m,
                 .color = kWallColor};
  return object;
}

void addOuterWalls(const Bounds2D& b, std::vector<WorldObject>& objects) {
  const double x = (b.x_min + b.x_max) / 2, y = (b.y_min + b.y_max) / 2;
  const double width_m = b.x_max - b.x_min, height_m = b.y_max - b.y_min, half_m = kWallThickness_m / 2;
  objects.push_back(wall("NorthWall", x, b.y_max - half_m, width_m, kWallThickness_m));
  objects.push_back(wall("SouthWall", x, b.y_min + half_m, width_m, kWallThickness_m));
  objects.push_back(wall("EastWall", b.x_max - half_m, y, kWallThickness_m, height_m));
  objects.push_back(wall("WestWall", b.x_min + half_m, y, kWallThickness_m, height_m));
}

World populated(Scenery scenery, const TeamOptions& team, std::uint64_t seed) {
  World world;
  world.bounds = scenery.bounds;
  world.objects = std::move(scenery.objects);
  Spread spread(scenery.places, seed);
  std::vector<mrpt::math::TPoint2D> starts;
  for (int i = 0; i < team.robots; ++i) {
    if (spread.choose(starts)) continue;
    throw ConfigError("the generated world has places for " + std::to_string(i) + " robots, not for " +
                      std::to_string(team.robots) + "; make it larger, or take fewer");
  }
  const auto name_of = [](std::size_t i) { return "Robot" + std::to_string(i + 1); };
  for (std::size_t i = 0; i < starts.size(); ++i) {
    RobotPlacement robot;
    robot.name = name_of(i);
    robot.model = team.models[i % team.models.size()];
    const double heading_rad = (static_cast<double>(spread.rng().below(4)) - 1) * std::numbers::pi / 2;
    robot.world_from_robot = {starts[i].x, starts[i].y, heading_rad};
    robot.color = pickColor(static_cast<int>(i));
    robot.controller = team.controller;
    if (starts.size() > 1) robot.neighbour = name_of((i + 1) % starts.size());
    world.robots.push_back(std::move(robot));
  }
  if (team.has_gold) {
    if (!spread.choose(starts)) throw ConfigError("the generated world has no place for gold; make it larger");
    world.objects.push_back(goldAt(starts.back()));
  }
  return world;
}

}  // namespace robosim
