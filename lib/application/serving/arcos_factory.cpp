#include "serving/arcos_factory.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/random.h"

namespace robosim {
namespace {

/// Places that are tried for a robot. In a world that is half full of robots, one in 1000 is free almost certainly.
constexpr int kPlaces = 1000;
/// Of them, those that are clear of robots and walls, but not of an object that has been moved.
constexpr int kRefusals = 10;
/// A stream of random numbers of its own: those of --random-robots are 0 and 1.
constexpr std::uint32_t kStream = 2;

}  // namespace

ArcosFactory::ArcosFactory(Environment& environment, std::string type, std::size_t most)
    : environment_(environment), type_(std::move(type)), most_(most) {}

std::optional<std::size_t> ArcosFactory::add() {
  if (!mayAdd()) return std::nullopt;
  if (!places_) {
    const auto& robots = environment_.fleet().robots;
    const auto kind =
        std::find_if(robots.begin(), robots.end(), [&](const auto& robot) { return robot.info.type->model == type_; });
    radius_m_ = kind->info.radius_m;
    places_.emplace(environment_.world(), Fleet(), *kind);
  }
  const std::size_t index = environment_.robotCount();
  Rng rng(environment_.state().seed, RandomPurpose::start_pose, kStream, static_cast<std::uint32_t>(index));
  int refusals = 0;
  for (int i = 0; i < kPlaces && refusals < kRefusals; ++i) {
    const auto place = places_->draw(rng);
    if (!place) return std::nullopt;
    const double heading_rad = rng.uniform(-M_PI, M_PI);
    if (!isClearOfRobots(*place)) continue;
    AddRobot robot{newName(), type_, {place->x, place->y, heading_rad}};
    if (environment_.apply({"ARCOS program", std::move(robot)}).empty()) {
      ++added_;
      return index;
    }
    ++refusals;
  }
  return std::nullopt;
}

bool ArcosFactory::isClearOfRobots(const mrpt::math::TPoint2D& place) const {
  const State& state = environment_.state();
  for (std::size_t i = 0; i < state.world_from_robot.size(); ++i) {
    if (state.isAbsent(i)) continue;
    const auto& other = state.world_from_robot[i];
    const double apart_m = radius_m_ + environment_.fleet().robots[i].info.radius_m + kContactGap_m;
    if (std::hypot(other.x - place.x, other.y - place.y) < apart_m) return false;
  }
  return true;
}

std::string ArcosFactory::newName() const {
  const auto& names = environment_.robotNames();
  const auto& objects = environment_.objects();
  for (std::size_t number = names.size() + 1;; ++number) {
    std::string name = "Robot" + std::to_string(number);
    const bool is_used =
        std::find(names.begin(), names.end(), name) != names.end() ||
        std::any_of(objects.begin(), objects.end(), [&](const auto& object) { return object.name == name; });
    if (!is_used) return name;
  }
}

}  // namespace robosim
