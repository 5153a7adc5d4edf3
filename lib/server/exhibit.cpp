#include "server/exhibit.h"

namespace robosim {

Exhibit::Exhibit(const Environment& the_environment, WorldSource the_source, std::uint64_t the_seed,
                 std::vector<std::uint8_t> networked)
    : environment(the_environment),
      source(std::move(the_source)),
      world_version(versionOf(source)),
      seed(the_seed),
      is_networked(std::move(networked)) {
  for (const auto& robot : environment.fleet().robots) {
    robot_named.emplace(robot.info.name, robot_names.size());
    robot_names.push_back(robot.info.name);
  }
}

}  // namespace robosim
