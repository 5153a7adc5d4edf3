#include "robosim/replay.h"

#include <algorithm>

#include <CLI/CLI.hpp>

#include "base/error_list.h"
#include "maze/controllers.h"
#include "robosim/arguments.h"
#include "robosim/run_outputs.h"
#include "robosim/subcommands.h"
#include "robosim/text.h"

namespace robosim {
namespace {

void replay(const ReplayArguments& arguments) {
  if (arguments.from_s && arguments.to_s && *arguments.from_s > *arguments.to_s) {
    throw ConfigError("--from is later than --to");
  }
  if (!arguments.check.empty()) return checkRun(arguments);
  if (!arguments.controller.empty()) return replayToController(arguments);
  if (arguments.print) return printObservations(arguments);
  summarise(arguments);
}

}  // namespace

bool ReplayArguments::wants(const std::string& robot, const std::string& sensor) const {
  const auto holds = [](const std::vector<std::string>& list, const std::string& what) {
    return list.empty() || std::find(list.begin(), list.end(), what) != list.end();
  };
  return holds(robots, robot) && holds(sensors, sensor);
}

void failInterrupted(double read_s) {
  throw std::runtime_error("interrupted; only the first " + fixed(read_s, 1) + " s of the recording were read");
}

void addReplay(CLI::App& program) {
  auto* command =
      program.add_subcommand("replay", "Summarise a recorded run, print it, run it again, or feed it to a controller");
  auto a = std::make_shared<ReplayArguments>();
  command->add_option("RAWLOG", a->rawlog, "an MRPT rawlog, of RoboSim's or anybody's")->type_name("FILE")->required();
  auto* robot = command->add_option("--robot", a->robots, "only this one; may be given several times");
  robot->type_name("NAME");
  auto* sensor =
      command
          ->add_option(
              "--sensor", a->sensors,
              "only this one, by its label on the robot (sonar, laser, GROUND_TRUTH, …); may be given several times")
          ->type_name("LABEL");
  auto* from =
      command->add_option("--from", a->from_s, "leave out what is earlier, counted from its first observation");
  from->type_name("SECONDS")->check(numberIn(0, 1e18));
  auto* to = command->add_option("--to", a->to_s, "leave out what is later");
  to->type_name("SECONDS")->check(numberIn(0, 1e18));

  auto* print = command->add_flag("--print", a->print, "print each observation, a line each");
  command->add_option("--speed", a->speed, "of printing: recorded seconds per second (1 is real time) or max")
      ->type_name("X|max")
      ->capture_default_str()
      ->needs(print);

  auto controllers = controllerNames();
  controllers.emplace_back("recorded");
  auto* controller =
      command
          ->add_option("--controller", a->controller,
                       "feed the recorded readings to it, and tell where its commands differ from those recorded; "
                       "'recorded' is the one that each robot had")
          ->check(CLI::IsMember(controllers));
  command
      ->add_option("--tolerance", a->tolerance,
                   "commands that differ by no more than this are the same [m/s, rad/s, rad]")
      ->check(numberIn(0, 1e6))
      ->capture_default_str()
      ->needs(controller);
  auto* check = command
                    ->add_option("--check", a->check,
                                 "run this world again with the recorded seed, and say whether it is the same run; if "
                                 "not, where it first differs")
                    ->type_name("WORLD");
  controller->excludes(print)->excludes(sensor)->excludes(from)->excludes(to);
  check->excludes(print)->excludes(controller)->excludes(robot)->excludes(sensor)->excludes(from)->excludes(to);
  command->add_flag("--json", a->json, "print the summary as one JSON object")
      ->excludes(print)
      ->excludes(controller)
      ->excludes(check);
  command->footer(
      "Pictures of a recording: robosim view RAWLOG.\n"
      "Exit: 0 done, 1 bad input, 2 --check found a difference.\n\n" +
      controllersHelp());
  command->callback([a] { replay(*a); });
}

}  // namespace robosim
