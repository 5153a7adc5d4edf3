#include <functional>
#include <iostream>
#include <optional>

#include <CLI/CLI.hpp>

#include "base/error_list.h"
#include "base/seconds.h"
#include "base/text_table.h"
#include "client/control_panel.h"
#include "robosim/arguments.h"
#include "robosim/command_line.h"
#include "robosim/connection.h"
#include "robosim/control_changes.h"
#include "robosim/subcommands.h"

namespace robosim {
namespace {

struct ControlArguments {
  ConnectionArguments connection;
  std::string world;
  std::optional<std::uint64_t> seed;
  std::uint64_t steps = 1;
  std::string speed;
  std::string record;
  bool watch = false;
  double period_s = 1;

  ConnectOptions connectOptions() const { return connection.awaitServer(connection.connectOptions(), "control"); }
};

const char* wordFor(v1::RunPhase phase) {
  switch (phase) {
    case v1::RUN_PHASE_WAITING:
      return "waits for robots";
    case v1::RUN_PHASE_PAUSED:
      return "paused";
    case v1::RUN_PHASE_RUNNING:
      return "running";
    case v1::RUN_PHASE_ENDED:
      return "ended";
    default:
      return "unknown state";
  }
}

/// Value of --on-lost-robot.
const char* wordFor(v1::LostRobotPolicy policy) {
  switch (policy) {
    case v1::LOST_ROBOT_POLICY_WAIT:
      return "wait";
    case v1::LOST_ROBOT_POLICY_CONTINUE:
      return "continue";
    case v1::LOST_ROBOT_POLICY_FAIL:
      return "fail";
    default:
      return "unknown";
  }
}

std::string lineOn(const v1::RunStatus& status) {
  return "step " + withCommas(status.step()) + " (" + fixed(status.time_s(), 1) + " s): " + wordFor(status.phase()) +
         ", " + withCommas(static_cast<std::uint64_t>(status.steps_per_s())) + " steps/s, " +
         withCommas(status.robots_active()) + " of " + withCommas(status.robots()) + " robots active";
}

std::string pageOn(const v1::RunStatus& status) {
  std::string robots = withCommas(status.robots()) + ", of which " + withCommas(status.robots_active()) +
                       " are active and " + withCommas(status.robots_connected()) + " in other processes";
  const std::vector<std::string> absent(status.robots_absent().begin(), status.robots_absent().end());
  const std::string speed =
      status.speed() == 0 ? "unlimited" : fixed(status.speed(), 3) + " simulated seconds per second";
  Rows rows{
      {"world", status.world() + ", version " + status.world_version()},
      {"run", std::string(wordFor(status.phase())) + " at step " + withCommas(status.step()) + ", " +
                  fixed(status.time_s(), 1) + " s"},
      {"speed", speed + "; recently " + withCommas(static_cast<std::uint64_t>(status.steps_per_s())) + " steps/s"},
      {"robots", robots}};
  if (!absent.empty()) rows.push_back({"absent", listed(absent)});
  for (const auto& robot : status.lost_robots()) {
    rows.push_back({"lost", robot.name() + ", " + withCommas(robot.times()) + " times, " +
                                (robot.is_lost() ? "not back" : "back") + "; " + withCommas(robot.steps_missed()) +
                                " steps were taken without it (--on-lost-robot " + wordFor(status.on_lost_robot()) +
                                ")"});
  }
  if (status.messages_lost() > 0) {
    rows.push_back({"lost", withCommas(status.messages_lost()) + " messages between robots"});
  }
  if (status.recording() == v1::RECORDING_STATE_ON) rows.push_back({"recording", "on, " + status.recording_file()});
  if (status.recording() == v1::RECORDING_STATE_OFF) {
    rows.push_back(
        {"recording", status.recording_file().empty() ? "off" : "off, last file " + status.recording_file()});
  }
  if (!status.recording_failure().empty()) rows.push_back({"recording", "has ended: " + status.recording_failure()});
  if (!status.winner().empty()) rows.push_back({"winner", status.winner()});
  if (status.late_commands() > 0)
    rows.push_back({"late", withCommas(status.late_commands()) + " commands (robots × steps)"});
  rows.push_back({"viewers", withCommas(status.viewers())});
  rows.push_back({"geometry", withCommas(status.geometry_workers()) + " workers" +
                                  (status.geometry_workers_rejected() == 0
                                       ? ""
                                       : ", and " + withCommas(status.geometry_workers_rejected()) +
                                             " rejected because their results were wrong")});
  return listing(rows);
}

void showLine(const v1::RunStatus& status) { std::cout << lineOn(status) << std::endl; }

void showStatus(const ControlArguments& a) {
  ControlPanel panel(a.connectOptions());
  if (a.watch) {
    panel.watch(Seconds(a.period_s), showLine);
  } else {
    std::cout << pageOn(panel.status());
  }
}

}  // namespace

void addControl(CLI::App& program) {
  auto* control = addSubcommand(program, "control");
  auto a = std::make_shared<ControlArguments>();
  control->add_option("ADDRESS", a->connection.environment, "address of 'robosim serve'")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  addSecurityOptions(*control, a->connection);
  addConnectTimeout(*control, a->connection);
  control->require_subcommand(1);
  const auto add = [&](const char* name, const char* help, const std::function<void()>& act) {
    auto* command = control->add_subcommand(name, help);
    command->fallthrough();  // options of `control` may also follow the subcommand
    command->callback(act);
    return command;
  };
  using Act = std::function<v1::RunStatus(ControlPanel&)>;
  const auto add_call = [&](const char* name, const char* help, const Act& act) {
    return add(name, help, [a, act] {
      ControlPanel panel(a->connectOptions());
      showLine(act(panel));
    });
  };

  auto* load = add("load", "end the run and start another with this world, paused", [a] {
    WorldSource source = readWorldSource(a->world);
    source.seed = a->seed;
    ControlPanel panel(a->connectOptions());
    showLine(panel.load(source));
  });
  load->add_option("FILE", a->world, "world file")->transform(inputFile(kWorldKinds))->required();
  load->add_option("--seed", a->seed, "of the new run; default: that of 'robosim serve'")
      ->check(seedNumber())
      ->type_name("NUMBER");
  add_call("start", "continue the run", [](ControlPanel& panel) { return panel.start(); });
  add_call("pause", "pause after the current step", [](ControlPanel& panel) { return panel.pause(); });
  add_call("step", "take a number of steps, then pause; returns on completion",
           [a](ControlPanel& panel) { return panel.step(a->steps); })
      ->add_option("N", a->steps)
      ->check(wholeNumberIn(1, 1'000'000'000))
      ->type_name("NUMBER")
      ->capture_default_str();
  add_call("speed", "simulated seconds per second: a number (1 is real time) or max",
           [a](ControlPanel& panel) { return panel.setSpeed(speedNumber(a->speed)); })
      ->add_option("X", a->speed)
      ->type_name("X|max")
      ->required();
  add_call("record", "start or stop the recording of a run that is served with --record",
           [a](ControlPanel& panel) { return panel.setRecording(a->record == "on"); })
      ->add_option("STATE", a->record, "on or off")
      ->check(CLI::IsMember({"on", "off"}))
      ->type_name("on|off")
      ->required();
  addChanges(*control, [a](const Change& change) {
    ControlPanel panel(a->connectOptions());
    showLine(panel.supervise(change));
  });
  add_call("stop", "end the run and the serving program", [](ControlPanel& panel) { return panel.stop(); });
  auto* status = add("status", "show the status of the run", [a] { showStatus(*a); });
  const auto* watch = status->add_flag("--watch", a->watch, "print one line per report until the run is over");
  auto* interval = status->add_option("--interval", a->period_s, "time between two reports")
                       ->check(numberIn(0.05, 3600))
                       ->type_name("SECONDS")
                       ->capture_default_str();
  dependsOn(interval, watch);
  acceptFormerName(*status, *interval, "--every");
}

}  // namespace robosim
