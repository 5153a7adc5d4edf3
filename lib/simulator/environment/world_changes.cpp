#include "environment/world_changes.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "base/angle_units.h"
#include "base/log.h"
#include "base/random.h"
#include "base/xml_element.h"
#include "base/xml_parser.h"
#include "environment/start_poses.h"
#include "robots/robot_type_includes.h"
#include "robots/scatter.h"
#include "robots/start_places.h"
#include "world/map_reader.h"
#include "world/world_file.h"

namespace robosim {
namespace {

constexpr double kFarthest_m = 1e7;  // maximum coordinate; also the maximum heading in degrees

/// Generates the names Robot1, Robot2, … not used by any object or robot of the world.
class FreeNames {
 public:
  explicit FreeNames(const World& world) {
    for (const auto& object : world.objects) taken_.insert(object.name);
    for (const auto& robot : world.robots) taken_.insert(robot.name);
  }
  /// @param wanted empty: the next free one
  std::string next(const std::string& wanted = {}) {
    if (!wanted.empty()) {
      if (!taken_.insert(wanted).second) {
        throw ConfigError("there are two robots or objects named '" + wanted + "'; use another name");
      }
      return wanted;
    }
    std::string name;
    do name = "Robot" + std::to_string(++last_);
    while (!taken_.insert(name).second);
    return name;
  }

 private:
  std::unordered_set<std::string> taken_;
  int last_ = 0;
};

RobotPlacement placed(const std::string& model, const mrpt::math::TPose2D& world_from_robot, std::string name) {
  RobotPlacement placement;
  placement.name = std::move(name);
  placement.model = model;
  placement.world_from_robot = world_from_robot;
  return placement;
}

/// The source's robot types and all others in its folders.
RobotTypes typesFor(const WorldSource& source) {
  RobotTypes types = source.robot_types;
  types.merge(robotTypesIn(robotTypeFolders(source.file)));
  return types;
}

Fleet fleetOf(const World& world, const std::string& file, const RobotTypes& types) {
  ErrorList errors;
  Fleet fleet = buildFleet(world, file, types, {}, errors);
  errors.throwIfAny();
  return fleet;
}

void addRobots(const WorldSource& source, const RobotTypes& types, const std::vector<AddedRobot>& robots,
               FreeNames& names, World& world) {
  std::string of_options;
  for (const auto& robot : robots) {
    if (!robot.world_from_robot) continue;
    world.robots.push_back(placed(robot.model, *robot.world_from_robot, names.next(robot.name)));
    of_options += (of_options.empty() ? "" : ", ") + world.robots.back().name;
  }
  if (of_options.empty()) return;
  try {
    fleetOf(world, source.file, types);
  } catch (const ConfigError& error) {
    std::vector<std::string> lines;
    const std::string no_line = source.file + ":0: ";
    for (const auto& line : error.errors()) {
      lines.push_back(line.starts_with(no_line) ? source.file + ": " + line.substr(no_line.size()) : line);
    }
    lines.push_back(source.file + ": the robots of --robot are " + of_options + ", in their order");
    throw ConfigError(lines);
  }
}

/// Adds the robots without a pose: in a world without robots the first by findStart() among the homes; the others by
/// findStartBeside().
void addRobotsNear(const std::vector<mrpt::math::TPose2D>& homes, const WorldSource& source, const RobotTypes& types,
                   const std::vector<AddedRobot>& robots, FreeNames& names, World& world) {
  for (const auto& robot : robots) {
    if (robot.world_from_robot) continue;
    RobotPlacement added = placed(robot.model, homes.front(), names.next(robot.name));
    std::optional<FoundStart> found;
    if (world.robots.empty()) {
      found = findStart(world, source.file, types, added, homes);
    } else if (const auto beside = findStartBeside(world, source.file, types, robot.model)) {
      found = FoundStart{*beside};
    }
    if (!found) {
      throw ConfigError("there is no room for robot '" + added.name + "' in " + source.file +
                        "; use fewer robots, or a larger world");
    }
    added.world_from_robot = found->world_from_robot;
    world.robots.push_back(added);
    const bool is_first_on_map = isMapFile(source.file) && world.robots.size() == 1;
    if (is_first_on_map && !found->warning.empty()) {
      logWarning("", source.file + ": robot '" + added.name + "' " + found->warning);
    }
  }
}

/// Links the robots from `first` on with their neighbours as a ring, or inserts them into a ring of those before.
void linkNeighbours(std::vector<RobotPlacement>& robots, std::size_t first) {
  if (first == robots.size()) return;
  const auto end = robots.begin() + static_cast<std::ptrdiff_t>(first);
  const auto before = std::find_if(robots.begin(), end, [](const auto& robot) { return !robot.neighbour.empty(); });
  for (std::size_t i = first; i + 1 < robots.size(); ++i) robots[i].neighbour = robots[i + 1].name;
  if (before != end) {
    robots.back().neighbour = std::exchange(before->neighbour, robots[first].name);
  } else if (robots.size() - first > 1) {
    robots.back().neighbour = robots[first].name;
  }
}

/// Adds robots at random positions in the largest region that is known to be free, clear of the existing robots.
void addRandomRobots(const WorldSource& source, const RobotTypes& types, const WorldChanges& changes,
                     std::uint64_t seed, FreeNames& names, World& world) {
  if (changes.random_robots == 0) return;
  FreePlaces places(world, fleetOf(world, source.file, types), robotOfType(types, changes.random_model));
  Rng rng(seed, RandomPurpose::start_pose, 1);
  for (int added = 0; added < changes.random_robots; ++added) {
    const auto place = places.takeRandom(rng);
    if (!place) {
      throw ConfigError("--random-robots " + std::to_string(changes.random_robots) + ": there is room for " +
                        std::to_string(added) + " robots '" + changes.random_model + "' only in " + source.file +
                        "; use fewer, or a larger world");
    }
    const mrpt::math::TPose2D start(place->x, place->y, rng.uniform(-M_PI, M_PI));
    world.robots.push_back(placed(changes.random_model, start, names.next()));
  }
}

/// Replaces the robots of the world by a team of the first one's kind.
void makeTeam(const WorldSource& source, const RobotTypes& types, int size, std::uint64_t seed, World& world) {
  if (world.robots.empty()) throw ConfigError(source.file + ": has no robots, so that a team of them cannot be made");
  const RobotPlacement first = world.robots.front();
  const FleetRobot type = fleetOf(world, source.file, types).robots.front();
  world.robots.clear();
  FreeNames names(world);
  FreePlaces places(world, fleetOf(world, source.file, types), type);
  Rng rng(seed, RandomPurpose::start_pose, 2);
  for (int i = 0; i < size; ++i) {
    const auto place = places.takeRandom(rng);
    if (!place) {
      throw ConfigError(source.file + ": there is room for " + std::to_string(i) + " of " + std::to_string(size) +
                        " robots only; use a smaller team, or a larger world");
    }
    RobotPlacement robot = first;
    robot.name = names.next();
    robot.world_from_robot = {place->x, place->y, rng.uniform(-M_PI, M_PI)};
    if (robot.body) robot.body->world_from_body = robot.world_from_robot;
    world.robots.push_back(std::move(robot));
  }
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    world.robots[i].neighbour = size > 1 ? world.robots[(i + 1) % world.robots.size()].name : "";
  }
}

/// Whether a world file has a <communication>; a map has none.
bool specifiesCommunication(const WorldSource& source) {
  if (isMapFile(source.file)) return false;
  const XmlElement root = parseXml(source.text, source.file);
  return std::any_of(root.children.begin(), root.children.end(),
                     [](const XmlElement& child) { return child.name == "communication"; });
}

/// The text of a type with noise added to its sensors.
std::string textOf(const RobotTypeFile& type, AddedNoise noise) {
  const std::string text = resolveIncludes(type);
  if (noise == AddedNoise::none) return text;
  XmlElement root = parseXml(text, type.file.string());
  for (auto& child : root.children) {
    if (child.name == "sensors") addNoise(noise, child.children);
  }
  return toXml(root);
}

}  // namespace

AddedRobot AddedRobot::parse(const std::string& text) {
  const auto error = [&]() -> ConfigError {
    return ConfigError("--robot " + text +
                       ": must be TYPE@X,Y or TYPE@X,Y,HEADING, in metres and degrees, as in pioneer3dx@1,2,90");
  };
  const std::size_t at = text.find('@');
  if (at == 0 || at == std::string::npos) throw error();
  std::vector<double> numbers;
  for (std::size_t begin = at + 1; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto number = parseNumber(text.substr(begin, end - begin));
    if (!number || !(std::abs(*number) <= kFarthest_m)) throw error();
    numbers.push_back(*number);
    begin = end + 1;
  }
  if (numbers.size() != 2 && numbers.size() != 3) throw error();
  const double heading_rad = numbers.size() == 3 ? toRadians(numbers[2]) : 0;
  return {text.substr(0, at), mrpt::math::TPose2D(numbers[0], numbers[1], heading_rad)};
}

WorldSource withChanges(const WorldSource& source, const WorldChanges& changes, std::uint64_t seed) {
  if (changes.isNone()) return source;
  ErrorList errors;
  World world = parseWorld(source.text, source.file, makeProvider(source.file, source.files), errors);
  const RobotTypes types = typesFor(source);
  placeScattered(world, source.file, types, source.seed.value_or(seed), errors);
  errors.throwIfAny();
  std::vector<mrpt::math::TPose2D> homes{{}};
  if (changes.addsRobots() && isMapFile(source.file)) {
    world.robots.clear();
    if (auto starts = startsOfMaps(world); !starts.empty()) homes = std::move(starts);
  } else if (hasRobotsAtMapStarts(world)) {
    world = placedWorld(std::move(world), source.file, types, {}, seed, errors).world;
    errors.throwIfAny();
  }
  if (changes.team) makeTeam(source, types, *changes.team, seed, world);
  if (changes.adds_radio_errors && !specifiesCommunication(source)) world.communication = kAddedRadio;
  if (changes.start_distance_m) world.start_distance_m = changes.start_distance_m;
  if (changes.message_loss) world.communication.loss_probability = *changes.message_loss;
  FreeNames names(world);
  addRobots(source, types, changes.robots, names, world);
  addRobotsNear(homes, source, types, changes.robots, names, world);
  const std::size_t named = world.robots.size();
  addRandomRobots(source, types, changes, seed, names, world);
  linkNeighbours(world.robots, named);
  if (changes.has_random_starts) {
    Fleet fleet = fleetOf(world, source.file, types);
    shuffleStartPoses(world, fleet, seed);
    for (std::size_t i = 0; i < world.robots.size(); ++i) {
      world.robots[i].world_from_robot = fleet.robots[i].world_from_start;
      if (world.robots[i].body) world.robots[i].body->world_from_body = fleet.robots[i].world_from_start;
    }
  }
  WorldSource changed = source;
  changed.robot_types.clear();
  const auto keep_type = [&](const std::string& model) {
    const auto type = types.find(model);
    if (type == types.end() || changed.robot_types.contains(model)) return;
    changed.robot_types[model] = {type->second.file, textOf(type->second, changes.noise)};
  };
  for (auto& robot : world.robots) {
    addNoise(changes.noise, robot.sensors);
    keep_type(robot.model);
  }
  for (const auto& timed : world.timeline) {
    if (const auto* robot = std::get_if<AddRobot>(&timed.change)) keep_type(robot->model);
  }
  changed.text = toXml(world);
  return changed;
}

LoadedWorld changedWorld(const std::string& file, const WorldChanges& changes, const ControllerCheck& check_controller,
                         std::uint64_t seed) {
  if (changes.isNone()) return loadWorld(file, check_controller, seed);
  WorldSource source = readWorldSource(file);
  source.seed = seed;
  return loadWorld(withChanges(source, changes, seed), check_controller);
}

}  // namespace robosim
