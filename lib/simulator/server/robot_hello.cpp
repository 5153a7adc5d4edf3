#include "server/robot_hello.h"

#include "base/error_list.h"
#include "net/wire_error.h"

namespace robosim {

void checkHello(const v1::RobotsHello& hello, const RunInfo& run_info) {
  checkProtocol(hello.protocol());
  if (!hello.world_version().empty() && hello.world_version() != run_info.world_version) {
    throw WireError("the robots require the world version " + inQuotes(hello.world_version()) +
                        ", and the environment has version " + run_info.world_version + " of the world " +
                        inQuotes(run_info.environment.world().name) + "; restart their program",
                    v1::ERROR_REASON_WORLD_VERSION);
  }
  if (!hello.run().empty() && hello.run() != run_info.run_id) {
    throw WireError("the robots have joined the run " + inQuotes(hello.run()) + ", and the current run is " +
                        run_info.run_id + "; restart their program to join it",
                    v1::ERROR_REASON_OTHER_RUN);
  }
  if (hello.names().empty()) throw WireError("a hello without a robot's name");
}

std::vector<std::size_t> resolveRobots(const v1::RobotsHello& hello, const RunInfo& run_info) {
  std::vector<std::size_t> robots;
  std::vector<std::uint8_t> is_named(run_info.robot_names.size(), 0);
  for (const auto& name : hello.names()) {
    const auto found = run_info.robot_named.find(name);
    if (found == run_info.robot_named.end()) {
      throw WireError("the world " + inQuotes(run_info.environment.world().name) + " has no robot " + inQuotes(name) +
                          "; it has " + listed(run_info.robot_names),
                      v1::ERROR_REASON_UNKNOWN_ROBOT, name);
    }
    const std::size_t robot = found->second;
    if (!run_info.is_networked[robot]) {
      throw WireError("robot " + inQuotes(name) +
                          " is driven by a controller in the environment; start the environment "
                          "with --wait-for-robots to leave it to a process of its own",
                      v1::ERROR_REASON_ROBOT_NOT_NETWORKED, name);
    }
    if (is_named[robot]) throw WireError("the hello names robot " + inQuotes(name) + " twice");
    is_named[robot] = 1;
    robots.push_back(robot);
  }
  return robots;
}

}  // namespace robosim
