#include "robots/world_source.h"

#include <utility>

#include "base/digest.h"
#include "base/file_kind.h"
#include "base/log.h"
#include "base/text_table.h"
#include "base/xml_element.h"
#include "robots/robot_type_includes.h"
#include "robots/start_places.h"
#include "world/caching_file_provider.h"
#include "world/world_file.h"

namespace robosim {
namespace {

void add(Digest& digest, const std::string& text) {
  digest.add(text.size());
  digest.addBytes(text.data(), text.size());
}

}  // namespace

namespace {

/// @param own robot types that belong to the world, before those in folders
WorldSource completed(std::string world_text, const std::filesystem::path& file, const FileProvider& disk,
                      RobotTypes own = {}) {
  WorldSource source;
  source.file = file.string();
  source.text = std::move(world_text);
  int unread = 0;
  const FileProvider kept{disk.folder, [&](const std::string& name) {
                            ++unread;
                            std::string text = disk.read(name);
                            --unread;
                            return source.files[name] = std::move(text);
                          }};
  ErrorList errors;  // reported by loadWorld(), unless a file is missing
  const World world = parseWorld(source.text, source.file, kept, errors);
  if (unread > 0) errors.throwIfAny();
  for (const auto& map : world.maps) {
    for (const auto& warning : map.plan.warnings) logWarning("", map.file + ": " + warning);
  }
  own.merge(robotTypesIn(robotTypeFolders(file)));
  const RobotTypes& known = own;
  const auto keep_type = [&](const std::string& model) {
    const auto type = known.find(model);
    if (type == known.end() || source.robot_types.count(model)) return;
    source.robot_types[model] = {type->second.file, resolveIncludes(type->second)};
  };
  for (const auto& robot : world.robots) keep_type(robot.model);
  for (const auto& scatter : world.scatters) {
    if (const auto* robot = std::get_if<RobotPlacement>(&scatter.copied)) keep_type(robot->model);
  }
  for (const auto& timed : world.timeline) {
    if (const auto* robot = std::get_if<AddRobot>(&timed.change)) keep_type(robot->model);
  }
  return source;
}

std::string metresText(const mrpt::math::TPose2D& pose) {
  return "(" + fixed(pose.x, 3) + ", " + fixed(pose.y, 3) + ") m";
}

/// Moves robots whose discs overlap something at their starts, as Stage allows for bodies that are no discs, to the
/// nearest free places. If one has none, all stay: loadWorld() reports what is wrong.
void moveBlockedRobots(WorldSource& source, std::vector<std::string>& notes) {
  ErrorList errors;
  World world = parseWorld(source.text, source.file, makeProvider(source.file, source.files), errors);
  if (!errors.empty()) return;
  buildFleet(world, source.file, source.robot_types, {}, errors);
  if (errors.empty()) return;
  std::vector<std::string> moved;
  try {
    for (auto& robot : std::exchange(world.robots, {})) {
      const auto found = findStart(world, source.file, source.robot_types, robot, {robot.world_from_robot});
      if (!found) return;
      const auto& to = found->world_from_robot;
      if (!found->warning.empty()) {
        moved.push_back(source.file + ": robot '" + robot.name + "' is moved from " +
                        metresText(robot.world_from_robot) + " to " + metresText(to) +
                        ", the nearest place where its disc overlaps nothing");
      }
      robot.world_from_robot = to;
      world.robots.push_back(robot);
    }
  } catch (const ConfigError&) {
    return;
  }
  source.text = toXml(world);
  notes.insert(notes.end(), moved.begin(), moved.end());
}

WorldSource fromStage(const std::filesystem::path& file, const FileProvider& disk, StageNotes* notes) {
  requireKind(file, kWorldKinds);
  requireNameOfKind(file);
  if (kindOfFile(file) == FileKind::other_xml) {
    throw ConfigError(file.string() +
                      ": is an XML file, such as a world of Gazebo, and no world of Stage; RoboSim's own "
                      "worlds end in .xml");
  }
  TranslatedStageWorld world = translateStageWorld(readXmlText(file), file.string(), disk);
  RobotTypes types;
  // Their names in errors, as if the world were a folder: a type's file is named as the type.
  for (auto& [name, text] : world.robot_types) types[name] = {file / (name + ".xml"), text};
  WorldSource source = completed(std::move(world.text), file, disk, std::move(types));
  moveBlockedRobots(source, world.notes);
  const std::size_t count = world.notes.size();
  if (notes) {
    *notes = {std::move(world.notes), world.properties};
  } else if (count > 0) {
    logWarning("", file.string() + ": " + std::to_string(count) + (count == 1 ? " thing" : " things") +
                       " of Stage left out or changed; robosim check lists " + (count == 1 ? "it" : "them"));
  }
  return source;
}

}  // namespace

WorldSource readWorldSource(const std::filesystem::path& file, StageNotes* notes) {
  const FileProvider disk = cachingFileProvider(filesOnDisk(file));
  if (isStageFile(file)) return fromStage(file, disk, notes);
  return completed(readWorldText(file, disk), file, disk);
}

WorldSource completeWorldSource(std::string text, const std::filesystem::path& file) {
  return completed(std::move(text), file, cachingFileProvider(filesOnDisk(file)));
}

LoadedWorld loadWorld(const WorldSource& source, const ControllerCheck& check_controller) {
  ErrorList errors;
  World world = parseWorld(source.text, source.file, makeProvider(source.file, source.files), errors);
  LoadedWorld loaded = placedWorld(std::move(world), source.file, source.robot_types, check_controller,
                                   source.seed.value_or(kDefaultSeed), errors);
  errors.throwIfAny();
  return loaded;
}

std::string versionOf(const WorldSource& source) {
  Digest digest;
  add(digest, source.text);
  for (const auto& [name, type] : source.robot_types) {
    add(digest, name);
    add(digest, type.text.value_or(""));
  }
  for (const auto& [name, text] : source.files) {
    add(digest, name);
    add(digest, text);
  }
  return digest.text();
}

}  // namespace robosim
