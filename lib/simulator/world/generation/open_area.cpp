#include <cmath>
#include <cstdint>
#include <numbers>
#include <unordered_map>

#include "base/portable_math.h"
#include "base/random.h"
#include "world/generation/bounds_check.h"
#include "world/generation/generators.h"

namespace robosim {
namespace {

double uniform(Rng& rng, double from, double to) { return rounded(rng.uniform(from, to)); }

constexpr double kGap_m = 0.8;        // between obstacles, so that robots pass
constexpr double kRadiusMax_m = 1.6;  // of an obstacle's covering disc
constexpr int kAttempts = 30;         // for each obstacle

/// Discs with a minimum gap, found by cells of the largest distance that matters.
class Discs {
 public:
  bool add(const Circle& disc) {
    const std::int64_t column = cell(disc.center.x), row = cell(disc.center.y);
    for (std::int64_t dy = -1; dy <= 1; ++dy) {
      for (std::int64_t dx = -1; dx <= 1; ++dx) {
        const auto found = cells_.find(key(column + dx, row + dy));
        if (found == cells_.end()) continue;
        for (const Circle& other : found->second) {
          const auto apart = other.center - disc.center;
          if (portable::hypot(apart.x, apart.y) < other.radius_m + disc.radius_m + kGap_m) return false;
        }
      }
    }
    cells_[key(column, row)].push_back(disc);
    return true;
  }

 private:
  static std::int64_t cell(double x) { return static_cast<std::int64_t>(std::floor(x / (2 * kRadiusMax_m + kGap_m))); }
  static std::int64_t key(std::int64_t column, std::int64_t row) { return row * 1'000'000 + column; }
  std::unordered_map<std::int64_t, std::vector<Circle>> cells_;
};

WorldObject randomObstacle(int number, Rng& rng) {
  WorldObject object = wall("", 0, 0, 1, 1);
  if (number % 3 == 0) {
    object.name = "Pillar" + std::to_string(number);
    object.body.shape = Cylinder{uniform(rng, 0.2, 0.6)};
  } else {
    object.name = "Box" + std::to_string(number);
    const double length_m = uniform(rng, 0.4, 3);
    object.body.shape = Cube{length_m, uniform(rng, 0.2, 1)};
  }
  object.body.height_m = uniform(rng, 0.5, 1.2);
  object.body.center_z_m = object.body.height_m / 2;
  return object;
}

}  // namespace

Scenery generateOpen(const OpenOptions& o, std::uint64_t seed) {
  requireWithin("width", o.width_m, 5, 1000);
  requireWithin("length", o.length_m, 5, 1000);
  requireWithin("clutter", o.clutter, 0, 1);
  Rng rng(seed, RandomPurpose::scenery);
  Scenery scenery;
  const double x_m = o.width_m / 2, y_m = o.length_m / 2;
  scenery.bounds = {-x_m, x_m, -y_m, y_m};
  addOuterWalls(scenery.bounds, scenery.objects);
  const int count = static_cast<int>(o.clutter * o.width_m * o.length_m);
  Discs discs;
  for (int number = 1; number <= count; ++number) {
    WorldObject object = randomObstacle(number, rng);
    const double radius_m = object.body.coveringRadius();
    const double margin_m = kWallThickness_m + kGap_m + radius_m;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const double x = uniform(rng, -x_m + margin_m, x_m - margin_m);
      const double y = uniform(rng, -y_m + margin_m, y_m - margin_m);
      if (!discs.add({{x, y}, radius_m})) continue;
      object.body.world_from_body = {x, y, uniform(rng, 0, std::numbers::pi)};
      scenery.objects.push_back(std::move(object));
      break;
    }
  }
  scenery.places = placesAmong(scenery.objects, scenery.bounds, 0.5, 0.4);
  return scenery;
}

}  // namespace robosim
