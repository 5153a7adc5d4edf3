#include "robots/robot_model_cache.h"

#include <functional>

#include "base/nearest_name.h"
#include "base/printable_text.h"
#include "robots/robot_type_folders_text.h"
#include "robots/robot_type_includes.h"

namespace robosim {
namespace {

void mix(std::size_t& hash, const std::string& text) { hash = hash * 1099511628211u ^ std::hash<std::string>{}(text); }

void mix(std::size_t& hash, const XmlElement& element) {
  mix(hash, element.name);
  mix(hash, element.text);
  for (const auto& [name, value] : element.attributes) {
    mix(hash, name);
    mix(hash, value);
  }
  for (const auto& child : element.children) mix(hash, child);
}

void mix(std::size_t& hash, double number) { hash = hash * 1099511628211u ^ std::hash<double>{}(number); }

/// Equal for robots that share a model.
std::size_t computeHash(const RobotPlacement& robot) {
  std::size_t hash = 0;
  mix(hash, robot.model);
  if (robot.body) mix(hash, robot.body->coveringRadius());
  for (const auto& sensor : robot.sensors) mix(hash, sensor);
  if (robot.drive) mix(hash, *robot.drive);
  return hash;
}

bool sameForm(const Rare<Body>& a, const Rare<Body>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->shape == b->shape && a->height_m == b->height_m && a->center_z_m == b->center_z_m;
}

bool shareModel(const RobotPlacement& a, const RobotPlacement& b) {
  return a.model == b.model && sameForm(a.body, b.body) && a.sensors == b.sensors && a.drive == b.drive;
}

}  // namespace

RobotModelCache::RobotModelCache(const World& world, std::string world_file, const RobotTypes& types, ErrorList& errors)
    : world_(world), world_file_(std::move(world_file)), errors_(errors) {
  for (const auto& [name, file] : types) types_[name].file = &file;
}

std::shared_ptr<const RobotModel> RobotModelCache::modelFor(const RobotPlacement& robot) {
  auto& bucket = made_[computeHash(robot)];
  for (const auto& made : bucket) {
    if (shareModel(*made.first, robot)) return made.model;
  }
  const std::size_t faults = errors_.count();
  const auto model = make(robot);
  // A faulty model is not cached, so that its fault is reported at the line of each robot that uses it.
  if (errors_.count() == faults) bucket.push_back({&robot, model});
  return model;
}

std::map<std::string, std::shared_ptr<const RobotModel>> RobotModelCache::modelsOfTypes() const {
  std::map<std::string, std::shared_ptr<const RobotModel>> models;
  for (const auto& [name, type] : types_) {
    if (type.model) models[name] = type.model;
  }
  return models;
}

const RobotModelCache::Type* RobotModelCache::typeOf(const RobotPlacement& robot) {
  const auto found = types_.find(robot.model);
  if (found == types_.end()) {
    // The types of a world that was read completely are those that it uses; others lie in the same folders.
    RobotTypes all = robotTypesIn(robotTypeFolders(world_file_));
    std::vector<std::string> known;
    for (const auto& [name, type] : types_) all.try_emplace(name);
    for (const auto& [name, type] : all) known.push_back(name);
    errors_.add(world_.fileOf(robot.line, world_file_), robot.line.number,
                "robot '" + quotable(robot.name) + "': there is no robot type '" + quotable(robot.model) + "'" +
                    didYouMean(robot.model, known) + "; " +
                    (known.empty() ? "none is known" : "known are: " + listed(known)) + "; " + robotTypeFoldersText());
    return nullptr;
  }
  Type& type = found->second;
  if (!type.was_read) {
    type.was_read = true;
    const std::size_t faults = errors_.count();
    try {
      type.root = readRobotType(*type.file);
      RobotModel model = modelOf(type.root, type.file->file.string(), {}, errors_);
      if (errors_.count() == faults) type.model = std::make_shared<const RobotModel>(std::move(model));
    } catch (const ConfigError& error) {
      errors_.add(error);
    }
  }
  return type.model ? &type : nullptr;
}

std::shared_ptr<const RobotModel> RobotModelCache::make(const RobotPlacement& robot) {
  RobotDescription description{.file = world_.fileOf(robot.line, world_file_), .unit_m = world_.unit_m};
  if (robot.body) description.body = &*robot.body;
  if (robot.drive) description.drive = &*robot.drive;
  if (robot.model.empty()) {
    if (!robot.body) return nullptr;  // already reported by the world's reader
    description.sensors = &robot.sensors;
    return std::make_shared<const RobotModel>(modelOf2005(description, errors_));
  }
  const Type* type = typeOf(robot);
  if (!type) return nullptr;
  if (!robot.sensors.empty()) description.sensors = &robot.sensors;
  if (!description.body && !description.sensors && !description.drive) return type->model;
  return std::make_shared<const RobotModel>(modelOf(type->root, type->file->file.string(), description, errors_));
}

}  // namespace robosim
