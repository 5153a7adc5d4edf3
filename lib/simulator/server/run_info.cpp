#include "server/run_info.h"

#include <random>

#include "base/digest.h"
#include "base/error_list.h"
#include "base/utf8.h"
#include "net/wire_error.h"
#include "robots/robot_type_includes.h"

namespace robosim {
namespace {

void checkUtf8(const std::string& name, const char* what) {
  if (isUtf8(name)) return;
  throw ConfigError(std::string("the name of the ") + what + " " + inQuotes(name) +
                    " is not UTF-8, as it must be to go from process to process; save the file that has it as UTF-8");
}

/// 64 random bits as hexadecimal digits. They identify the run to clients and have no effect on it.
std::string randomRunId() {
  std::random_device random;
  Digest digest;
  for (int i = 0; i < 4; ++i) digest.add(std::uint32_t{random()});
  return digest.text();
}

}  // namespace

RunInfo::RunInfo(const Environment& the_environment, WorldSource the_source, std::uint64_t the_seed,
                 std::vector<std::uint8_t> networked)
    : environment(the_environment),
      source(std::move(the_source)),
      world_version(versionOf(source)),
      run_id(randomRunId()),
      seed(the_seed),
      is_networked(std::move(networked)) {
  source.seed = seed;
  checkUtf8(environment.world().name, "world");
  for (const auto& robot : environment.fleet().robots) {
    checkUtf8(robot.info.name, "robot");
    checkUtf8(robot.info.type->model, "robot type");
    robot_named.emplace(robot.info.name, robot_names.size());
    robot_names.push_back(robot.info.name);
  }
}

void RunInfo::addRobots(const std::vector<std::uint8_t>& are_networked) {
  const Fleet& fleet = environment.fleet();
  is_networked.insert(is_networked.end(), are_networked.begin(), are_networked.end());
  for (std::size_t i = robot_names.size(); i < fleet.robots.size(); ++i) {
    robot_named.emplace(fleet.robots[i].info.name, i);
    robot_names.push_back(fleet.robots[i].info.name);
  }
  if (!fleet.known_types) return;
  for (const AddRobot& added : environment.state().additions.list()) {
    const auto type = fleet.known_types->types.find(added.model);
    if (type == fleet.known_types->types.end() || source.robot_types.contains(added.model)) continue;
    source.robot_types[added.model] = {type->second.file, resolveIncludes(type->second)};
  }
}

}  // namespace robosim
