#include "environment/start_poses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <mrpt/core/format.h>

#include "base/error_list.h"
#include "base/random.h"
#include "environment/referee.h"
#include "geometry/shapes/path.h"
#include "robots/free_space.h"

namespace robosim {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

/// Share of the places that RandomStarts leaves, so that starts differ also in small worlds.
constexpr double kShareMin = 0.1;

/// The distance from which no robot senses or wins the gold [m].
double unawareDistance(const World& world, const Fleet& fleet, double radius_m) {
  double distance_m = world.win_distance_m + radius_m;
  for (const auto& robot : fleet.robots) {
    for (const auto& sensor : *robot.info.sensors) {
      if (sensor.kind == SensorKind::heat) distance_m = std::max(distance_m, sensor.range_max_m);
    }
  }
  return distance_m;
}

}  // namespace

RandomStarts::RandomStarts(const World& world, const Fleet& fleet)
    : world_name_(world.name), robots_(fleet.robots.size()), required_distance_m_(world.start_distance_m) {
  if (fleet.robots.empty()) return;
  HeightSpan heights = fleet.robots.front().body().heights();
  std::vector<TPoint2D> starts;
  for (const auto& robot : fleet.robots) {
    radius_m_ = std::max(radius_m_, robot.info.radius_m);
    heights.z_min_m = std::min(heights.z_min_m, robot.body().heights().z_min_m);
    heights.z_max_m = std::max(heights.z_max_m, robot.body().heights().z_max_m);
    starts.emplace_back(robot.world_from_start.x, robot.world_from_start.y);
  }
  const FreeSpace raster(world, radius_m_, heights);
  const std::vector<Outline> gold = findGold(world.objects);
  for (const auto cell : raster.reachableFrom(starts)) {
    Place& place = places_.emplace_back(Place{raster.place(cell), std::numeric_limits<double>::infinity()});
    for (const auto& outline : gold)
      place.distance_m = std::min(place.distance_m, robosim::distance(outline, place.at));
  }
  if (!gold.empty() && !places_.empty()) chooseDistance(world, fleet);
}

void RandomStarts::chooseDistance(const World& world, const Fleet& fleet) {
  std::vector<Place> farthest_first = places_;
  std::stable_sort(farthest_first.begin(), farthest_first.end(),
                   [](const Place& a, const Place& b) { return a.distance_m > b.distance_m; });
  const auto last_of_share = static_cast<std::size_t>(std::ceil(kShareMin * static_cast<double>(places_.size()))) - 1;
  distance_m_ = required_distance_m_.value_or(
      std::min(unawareDistance(world, fleet, radius_m_), farthest_first[last_of_share].distance_m));
  if (required_distance_m_) return;
  const auto nearer = std::find_if(farthest_first.begin(), farthest_first.end(),
                                   [this](const Place& place) { return place.distance_m < distance_m_; });
  nearer_.assign(nearer, farthest_first.end());
}

bool RandomStarts::isClear(const TPoint2D& place, const std::vector<TPose2D>& starts) const {
  return std::none_of(starts.begin(), starts.end(), [&](const TPose2D& other) {
    return (TPoint2D(other.x, other.y) - place).norm() < 2 * radius_m_ + kContactGap_m;
  });
}

std::vector<TPose2D> RandomStarts::draw(std::uint64_t seed) const {
  Rng rng(seed, RandomPurpose::start_pose);
  std::vector<TPose2D> starts;
  const auto take = [&](const Place& place) {
    if (isClear(place.at, starts)) starts.emplace_back(place.at.x, place.at.y, rng.uniform(-M_PI, M_PI));
  };
  // Places that are too near are drawn and passed over, so that a distance changes only the starts that it excludes.
  for (std::vector<Place> left = places_; starts.size() < robots_ && !left.empty();) {
    const std::size_t drawn = rng.below(static_cast<std::uint32_t>(left.size()));
    const Place place = left[drawn];
    left[drawn] = left.back();
    left.pop_back();
    if (place.distance_m >= distance_m_) take(place);
  }
  for (auto place = nearer_.begin(); starts.size() < robots_ && place != nearer_.end(); ++place) take(*place);
  if (starts.size() == robots_) return starts;
  const bool has_distance = required_distance_m_ && distance_m_ > 0;
  throw ConfigError("world '" + world_name_ + "': there is not enough space to shuffle " + std::to_string(robots_) +
                    " robots" + (has_distance ? mrpt::format(" %.3g m away from the gold", distance_m_) : "") +
                    "; use fewer robots" + (has_distance ? ", a shorter distance" : "") + " or a larger world");
}

void setStartPoses(Fleet& fleet, std::span<const TPose2D> starts) {
  for (std::size_t i = 0; i < starts.size(); ++i) {
    fleet.robots[i].world_from_start = starts[i];
  }
}

void shuffleStartPoses(const World& world, Fleet& fleet, std::uint64_t seed) {
  setStartPoses(fleet, RandomStarts(world, fleet).draw(seed));
}

}  // namespace robosim
