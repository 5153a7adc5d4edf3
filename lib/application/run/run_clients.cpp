#include "run/run_clients.h"

#include <nlohmann/json.hpp>

namespace robosim {
namespace {

std::string textOn(const LostRobot& robot) {
  return robot.name + (robot.times == 1 ? ", once" : ", " + withCommas(robot.times) + " times") +
         (robot.is_lost ? ", not back" : ", back") + "; " + withCommas(robot.steps_missed) +
         " steps were taken without it";
}

}  // namespace

nlohmann::ordered_json clientsJson(const RunReport& report) {
  nlohmann::ordered_json lost = nlohmann::ordered_json::array();
  for (const auto& robot : report.lost_robots) {
    lost.push_back({{"name", robot.name},
                    {"times", robot.times},
                    {"steps_missed", robot.steps_missed},
                    {"is_lost", robot.is_lost},
                    {"restarts", robot.restarts}});
  }
  nlohmann::ordered_json rejected = nlohmann::ordered_json::array();
  for (const auto& worker : report.rejected_workers) {
    rejected.push_back({{"peer", worker.peer}, {"step", worker.step}, {"reason", worker.reason}});
  }
  return {{"all_robots", report.hasAllRobots()},
          {"restarted_robots", report.restartedRobots()},
          {"on_lost_robot", nameOf(report.on_lost_robot)},
          {"lost_robots", lost},
          {"messages_lost", report.messages_lost},
          {"geometry_workers", report.geometry_workers},
          {"geometry_results", report.geometry_results},
          {"results_checked", report.results_checked},
          {"corrupted_messages", report.corrupted_messages},
          {"trusted", report.isTrusted()},
          {"rejected_workers", rejected}};
}

void addClients(const RunReport& report, Rows& rows) {
  for (const auto& robot : report.lost_robots) rows.push_back({"lost", textOn(robot)});
  if (report.messages_lost > 0) rows.push_back({"lost", withCommas(report.messages_lost) + " messages between robots"});
  if (report.geometry_workers > 0) {
    rows.push_back({"geometry", withCommas(report.geometry_workers) + " workers computed " +
                                    withCommas(report.geometry_results) + " results, of which " +
                                    withCommas(report.results_checked) + " were recomputed to check them"});
  }
  if (report.corrupted_messages > 0) {
    rows.push_back({"corrupted", withCommas(report.corrupted_messages) + " messages of geometry workers, discarded"});
  }
  for (const auto& worker : report.rejected_workers) {
    rows.push_back(
        {"rejected", "geometry worker " + worker.peer + " at step " + withCommas(worker.step) + ": " + worker.reason});
  }
}

}  // namespace robosim
