#include <chrono>
#include <functional>
#include <iostream>

#include <CLI/CLI.hpp>

#include "base/error_list.h"
#include "robosim/arguments.h"
#include "robosim/connection.h"
#include "robosim/subcommands.h"
#include "robosim/text.h"
#include "server/control_panel.h"

namespace robosim {
namespace {

struct Arguments {
  ConnectionArguments connection;
  std::string world;
  std::uint64_t steps = 1;
  std::string speed;
  bool watch = false;
  double period_s = 1;
};

const char* wordFor(wire::RunPhase phase) {
  switch (phase) {
    case wire::WAITING:
      return "waits for robots";
    case wire::PAUSED:
      return "paused";
    case wire::RUNNING:
      return "running";
    case wire::ENDED:
      return "ended";
    default:
      return "in a state that this program does not know";
  }
}

std::string lineOn(const wire::RunStatus& status) {
  return "step " + withCommas(status.step()) + " (" + fixed(status.time_s(), 1) + " s): " + wordFor(status.phase()) +
         ", " + withCommas(static_cast<std::uint64_t>(status.steps_per_s())) + " steps/s, " +
         withCommas(status.robots_active()) + " of " + withCommas(status.robots()) + " robots active";
}

std::string pageOn(const wire::RunStatus& status) {
  std::string robots = withCommas(status.robots()) + ", of which " + withCommas(status.robots_active()) +
                       " are active and " + withCommas(status.robots_connected()) + " in processes of their own";
  const std::vector<std::string> absent(status.robots_absent().begin(), status.robots_absent().end());
  const std::string speed =
      status.speed() == 0 ? "as fast as it can" : fixed(status.speed(), 3) + " simulated seconds a second";
  Rows rows{{"world", status.world() + ", version " + status.world_version()},
            {"run", std::string(wordFor(status.phase())) + " at step " + withCommas(status.step()) + ", " +
                        fixed(status.time_s(), 1) + " s"},
            {"speed", speed + "; lately " + withCommas(static_cast<std::uint64_t>(status.steps_per_s())) + " steps/s"},
            {"robots", robots}};
  if (!absent.empty()) rows.push_back({"absent", listed(absent)});
  if (!status.winner().empty()) rows.push_back({"winner", status.winner()});
  if (status.late() > 0) rows.push_back({"late", withCommas(status.late()) + " commands (robots × steps)"});
  rows.push_back({"viewers", withCommas(status.viewers())});
  rows.push_back({"geometry", withCommas(status.geometry_workers()) + " workers"});
  return listing(rows);
}

void showLine(const wire::RunStatus& status) { std::cout << lineOn(status) << std::endl; }

void showStatus(const Arguments& a) {
  ControlPanel panel(a.connection.dialOptions());
  if (a.watch) {
    panel.watch(std::chrono::duration<double>(a.period_s), showLine);
  } else {
    std::cout << pageOn(panel.status());
  }
}

}  // namespace

void addControl(CLI::App& program) {
  auto* control = program.add_subcommand("control", "The control panel of an environment elsewhere");
  auto a = std::make_shared<Arguments>();
  control->add_option("ADDRESS", a->connection.environment, "where 'robosim serve' listens")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  addSecurityOptions(*control, a->connection);
  control->require_subcommand(1);
  const auto add = [&](const char* name, const char* help, const std::function<void()>& act) {
    auto* command = control->add_subcommand(name, help);
    command->fallthrough();  // options of `control` may stand at the end too
    command->callback(act);
    return command;
  };
  using Act = std::function<wire::RunStatus(ControlPanel&)>;
  const auto add_call = [&](const char* name, const char* help, const Act& act) {
    return add(name, help, [a, act] {
      ControlPanel panel(a->connection.dialOptions());
      showLine(act(panel));
    });
  };

  add_call("load", "end the run, and begin another with this world, paused",
           [a](ControlPanel& panel) { return panel.load(readWorldSource(a->world)); })
      ->add_option("FILE", a->world, "world file")
      ->required();
  add_call("start", "let the run go on", [](ControlPanel& panel) { return panel.start(); });
  add_call("pause", "halt after the step that is being taken", [](ControlPanel& panel) { return panel.pause(); });
  add_call("step", "take so many steps, then pause; returns when they are done",
           [a](ControlPanel& panel) { return panel.step(a->steps); })
      ->add_option("N", a->steps)
      ->check(CLI::Range(1, 1'000'000'000))
      ->capture_default_str();
  add_call("speed", "simulated seconds per second: a number (1 is real time) or max",
           [a](ControlPanel& panel) { return panel.setSpeed(speedNumber(a->speed)); })
      ->add_option("X", a->speed)
      ->type_name("X|max")
      ->required();
  add_call("stop", "end the run, and the program that serves it", [](ControlPanel& panel) { return panel.stop(); });
  auto* status = add("status", "how the run stands", [a] { showStatus(*a); });
  status->add_flag("--watch", a->watch, "keep printing, a line for each report, until the run is over");
  status->add_option("--every", a->period_s, "with --watch: how long from one report to the next")
      ->check(numberIn(0.01, 3600))
      ->type_name("SECONDS")
      ->capture_default_str();
}

}  // namespace robosim
