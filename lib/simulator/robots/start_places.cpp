#include "robots/start_places.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/portable_pose.h"
#include "base/printable_text.h"
#include "base/xml_element.h"
#include "geometry/shapes/path.h"
#include "world/map_reader.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

std::string placeText(const TPose2D& place) {
  const auto text = [](double at_m) { return toText(std::round(at_m * 1000) / 1000 + 0.0); };
  return "(" + text(place.x) + ", " + text(place.y) + ") m";
}

std::string notFree(const TPose2D& start) { return "the map's start " + placeText(start) + " is not free"; }

std::string makeWarning(const TPose2D& found, const char* what, const TPose2D& instead_of) {
  return "stands at " + placeText(found) + ", the " + what + ": " + notFree(instead_of);
}

/// Indices of the robots that stand at one of these starts.
std::vector<std::size_t> robotsAt(const std::vector<TPose2D>& starts, const World& world) {
  std::vector<std::size_t> robots;
  if (starts.empty()) return robots;
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    const TPose2D& at = world.robots[i].world_from_robot;
    const bool is_start = std::any_of(starts.begin(), starts.end(),
                                      [&](const TPose2D& start) { return start.x == at.x && start.y == at.y; });
    if (is_start) robots.push_back(i);
  }
  return robots;
}

Fleet makeValidFleet(const World& world, const std::string& world_file, const RobotTypes& types) {
  ErrorList errors;
  Fleet fleet = buildFleet(world, world_file, types, {}, errors);
  errors.throwIfAny();
  return fleet;
}

}  // namespace

FreePlaces::FreePlaces(const World& world, const Fleet& others, FleetRobot kind)
    : world_(world), kind_(std::move(kind)), free_(world, kind_.info.radius_m, kind_.body().heights()) {
  free_.blockUnknown(world);
  cells_ = free_.largestRegion();
  for (const auto& robot : others.robots) {
    taken_.push_back({{robot.world_from_start.x, robot.world_from_start.y}, robot.info.radius_m});
  }
}

std::optional<TPoint2D> FreePlaces::takeRandom(Rng& rng) {
  while (!cells_.empty()) {
    const std::size_t draw = rng.below(static_cast<std::uint32_t>(cells_.size()));
    const TPoint2D place = free_.place(cells_[draw]);
    cells_[draw] = cells_.back();
    cells_.pop_back();
    if (take(place)) return place;
  }
  return std::nullopt;
}

std::optional<TPoint2D> FreePlaces::draw(Rng& rng) const {
  if (cells_.empty()) return std::nullopt;
  return free_.place(cells_[rng.below(static_cast<std::uint32_t>(cells_.size()))]);
}

std::optional<TPoint2D> FreePlaces::takeNearest(const TPoint2D& to, double clearance_m,
                                                const std::function<bool(const TPoint2D&)>& is_wanted) {
  const auto distance = [&](std::size_t cell) { return (free_.place(cell) - to).sqrNorm(); };
  std::stable_sort(cells_.begin(), cells_.end(),
                   [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
  for (const std::size_t cell : cells_) {
    const TPoint2D place = free_.place(cell);
    if ((!is_wanted || is_wanted(place)) && take(place, clearance_m)) return place;
  }
  return std::nullopt;
}

bool FreePlaces::takeAt(const TPoint2D& place, double clearance_m) {
  const double half_cell_m = free_.cellSide() / 2;
  const bool is_in_region = std::any_of(cells_.begin(), cells_.end(), [&](std::size_t cell) {
    const TPoint2D center = free_.place(cell);
    return std::abs(center.x - place.x) <= half_cell_m && std::abs(center.y - place.y) <= half_cell_m;
  });
  const Circle disc{place, kind_.info.radius_m + kContactGap_m};
  if (!is_in_region || !world_.bounds.covers(boundsOf(disc))) return false;
  const Solid solid{disc, kind_.body().heights()};
  const auto solids = startSolids(world_);
  return std::none_of(solids.begin(), solids.end(), [&](const Solid& other) { return overlap(solid, other); }) &&
         take(place, clearance_m);
}

bool FreePlaces::take(const TPoint2D& place, double clearance_m) {
  constexpr double kRounding_m = 1e-9;
  const double gap_m = std::max(clearance_m - kRounding_m, kContactGap_m);
  const bool is_clear = std::none_of(taken_.begin(), taken_.end(), [&](const Circle& other) {
    return (other.center - place).norm() < other.radius_m + kind_.info.radius_m + gap_m;
  });
  if (is_clear) taken_.push_back({place, kind_.info.radius_m});
  return is_clear;
}

std::optional<FoundStart> findStart(World& world, const std::string& world_file, const RobotTypes& types,
                                    const RobotPlacement& robot, const std::vector<TPose2D>& starts) {
  const Fleet others = makeValidFleet(world, world_file, types);
  struct Added {
    World& world;
    explicit Added(World& to, const RobotPlacement& robot) : world(to) { world.robots.push_back(robot); }
    ~Added() { world.robots.pop_back(); }
  };
  std::optional<FleetRobot> kind;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Added added(world, robot);
    RobotPlacement& placed = world.robots.back();
    placed.world_from_robot = starts[i];
    if (placed.body) placed.body->world_from_body = starts[i];
    ErrorList errors;
    const Fleet fleet = buildFleet(world, world_file, types, {}, errors);
    if (fleet.robots.size() < world.robots.size()) errors.throwIfAny();  // its model is faulty
    if (errors.empty())
      return FoundStart{starts[i], i == 0 ? "" : makeWarning(starts[i], "next free start", starts[0])};
    kind = fleet.robots.back();
  }
  const TPose2D& first = starts.front();
  const auto place = FreePlaces(world, others, *kind).takeNearest({first.x, first.y});
  if (!place) return std::nullopt;
  const TPose2D world_from_robot(place->x, place->y, first.phi);
  return FoundStart{world_from_robot, makeWarning(world_from_robot, "nearest free place", first)};
}

std::optional<TPose2D> findStartBeside(const World& world, const std::string& world_file, const RobotTypes& types,
                                       const std::string& type) {
  const Fleet others = makeValidFleet(world, world_file, types);
  const FleetRobot kind = robotOfType(types, type);
  FreePlaces places(world, others, kind);
  // A robot behind another one has less room to drive.
  for (const bool is_behind : {false, true}) {
    for (const auto& other : others.robots) {
      const double apart_m = other.info.radius_m + kind.info.radius_m + kClearanceBeside_m;
      const std::vector<TPose2D> other_from_robot = is_behind
                                                        ? std::vector{TPose2D(-apart_m, 0, 0)}
                                                        : std::vector{TPose2D(0, apart_m, 0), TPose2D(0, -apart_m, 0)};
      for (const TPose2D& at : other_from_robot) {
        const TPose2D start = portable::compose(other.world_from_start, at);
        if (places.takeAt({start.x, start.y}, kClearanceBeside_m)) return start;
      }
    }
  }
  const TPose2D& first = others.robots.front().world_from_start;
  const auto is_not_ahead = [&](const TPoint2D& place) {
    return portable::relative(first, TPose2D(place.x, place.y, 0)).x <= 0;
  };
  auto place = places.takeNearest({first.x, first.y}, kClearanceBeside_m, is_not_ahead);
  if (!place) place = places.takeNearest({first.x, first.y}, kClearanceBeside_m);
  if (!place) place = places.takeNearest({first.x, first.y});
  if (!place) return std::nullopt;
  return TPose2D(place->x, place->y, first.phi);
}

std::vector<TPose2D> startsOfMaps(const World& world) {
  std::vector<TPose2D> starts;
  for (const auto& map : world.maps) {
    for (const auto& start : map.plan.starts) starts.push_back(portable::compose(map.world_from_map, start));
  }
  return starts;
}

bool hasRobotsAtMapStarts(const World& world) { return !robotsAt(startsOfMaps(world), world).empty(); }

std::vector<std::string> moveFromBlockedStarts(World& world, const std::string& world_file, const RobotTypes& types,
                                               ErrorList& errors) {
  const std::vector<TPose2D> all = startsOfMaps(world);
  const std::vector<std::size_t> at_starts = robotsAt(all, world);
  std::vector<std::string> warnings;
  const auto is_at_start = [&](std::size_t i) {
    return std::find(at_starts.begin(), at_starts.end(), i) != at_starts.end();
  };
  World placed = world;  // without those that have no place yet
  placed.robots.clear();
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    if (!is_at_start(i)) placed.robots.push_back(world.robots[i]);
  }
  std::vector<std::size_t> without_room;
  for (const std::size_t i : at_starts) {
    RobotPlacement& robot = world.robots[i];
    const TPose2D given = robot.world_from_robot;
    std::vector<TPose2D> starts{given};
    for (const TPose2D& start : all) {
      if (start.x != given.x || start.y != given.y) starts.push_back(start);
    }
    std::optional<FoundStart> found;
    try {
      found = findStart(placed, world_file, types, robot, starts);
    } catch (const ConfigError& error) {
      errors.add(error);
      return warnings;
    }
    const std::string line = robot.line.number > 0 ? ":" + std::to_string(robot.line.number) : "";
    const std::string what = world.fileOf(robot.line, world_file) + line + ": robot '" + quotable(robot.name) + "' ";
    const std::string blocked = notFree(given);
    if (!found && isMapFile(world_file)) {
      without_room.push_back(i);
      warnings.push_back(what + "is left out: " + blocked + ", and there is no room elsewhere");
      continue;
    }
    if (!found) {
      errors.add(world.fileOf(robot.line, world_file), robot.line.number,
                 "robot '" + robot.name + "': " + blocked + ", and there is no room elsewhere; give it a place");
      return warnings;
    }
    if (!found->warning.empty()) warnings.push_back(what + found->warning);
    robot.world_from_robot = found->world_from_robot;
    if (robot.body) robot.body->world_from_body = robot.world_from_robot;
    placed.robots.push_back(robot);
  }
  for (auto i = without_room.rbegin(); i != without_room.rend(); ++i) {
    world.robots.erase(world.robots.begin() + static_cast<std::ptrdiff_t>(*i));
  }
  return warnings;
}

}  // namespace robosim
