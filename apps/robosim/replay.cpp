#include "replay/replay.h"

#include <CLI/CLI.hpp>

#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/rereadable_file.h"
#include "robosim/arguments.h"
#include "robosim/command_line.h"
#include "robosim/run_arguments.h"
#include "robosim/subcommands.h"
#include "run/run_observers.h"

namespace robosim {
namespace {

ReplayResult replay(ReplayArguments arguments) {
  if (arguments.from_s && arguments.to_s && *arguments.from_s > *arguments.to_s) {
    throw ConfigError("--from is later than --to");
  }
  refuseSameFile(
      {{"RAWLOG", arguments.rawlog}, {"--output", arguments.output}, {"--ground-truth", arguments.ground_truth}});
  if (!arguments.output.empty()) return writeSelection(arguments);
  if (!arguments.ground_truth.empty()) return writeGroundTruth(arguments);
  const bool is_repeated = !arguments.check.empty() || !arguments.observers.empty();
  if (arguments.json && !arguments.check.empty() && arguments.observers.empty()) {
    throw ConfigError("--json: prints the summary, or the metrics of an --observer; omit it, or add an --observer");
  }
  checkObservers(arguments.observers);
  if (!is_repeated && arguments.controller.empty()) {
    return arguments.index   ? printIndex(arguments)
           : arguments.print ? printObservations(arguments)
                             : summarise(arguments);
  }
  const RereadableFile rawlog(arguments.rawlog);  // required by both branches, which read it more than once
  arguments.rawlog = rawlog.path().string();
  if (is_repeated) {
    return checkRun(arguments);
  }
  return replayToController(arguments);
}

}  // namespace

void addReplay(CLI::App& program) {
  auto* command = addSubcommand(program, "replay");
  auto a = std::make_shared<ReplayArguments>();
  command
      ->add_option(
          "RAWLOG", a->rawlog,
          "a recording of RoboSim or another program: an MRPT rawlog, a bag of ROS 2 (.mcap, .db3 or its folder), or a "
          "log of CARMEN (.log, .clf)")
      ->transform(inputFile(kRecordingKinds))
      ->type_name("FILE")
      ->required();
  auto* robot = command->add_option("--robot", a->robots, "select this robot; repeatable");
  robot->type_name("NAME");
  auto* sensor =
      command
          ->add_option("--sensor", a->sensors,
                       "select this sensor by its label on the robot (sonar, laser, GROUND_TRUTH, …); repeatable")
          ->type_name("LABEL");
  auto* from = command->add_option("--from", a->from_s, "omit earlier observations; relative to the first observation");
  from->type_name("SECONDS")->check(numberIn(0, 1e18));
  auto* to = command->add_option("--to", a->to_s, "omit later observations");
  to->type_name("SECONDS")->check(numberIn(0, 1e18));

  auto* print = command->add_flag("--print", a->print, "print one line per observation");
  dependsOn(command->add_flag("--csv", a->csv,
                              "comma-separated values, with a line of column names before each label's first "
                              "observation: seconds, label, and all values in full; empty for no echo"),
            print);
  dependsOn(command
                ->add_option_function<std::string>(
                    "--speed", [a](const std::string& text) { a->speed = speedNumber(text); },
                    "recorded seconds per second (1 is real time) or max")
                ->type_name("X|max")
                ->default_str("max"),
            print);

  auto* index = command->add_flag("--index", a->index,
                                  "print topics, times and the run of an .mcap, which its index says, in place of the "
                                  "summary, for which the whole recording is read");
  index->excludes(print)->excludes(robot)->excludes(sensor)->excludes(from)->excludes(to);
  auto* controller = addControllerOption(
      *command, a->controller,
      "feed the recorded readings to this controller, and report where its commands differ from those recorded; "
      "'recorded' selects each robot's recorded controller",
      "recorded");
  dependsOn(
      command
          ->add_option("--tolerance", a->tolerance, "commands that differ by at most this are equal [m/s, rad/s, rad]")
          ->check(numberIn(0, 1e6))
          ->type_name("NUMBER")
          ->capture_default_str(),
      controller);
  auto* check =
      command
          ->add_option("--check", a->check,
                       "repeat the run of this world with the recorded seed, and report whether it is identical; if "
                       "not, where it first differs")
          ->type_name("WORLD")
          ->transform(inputFile(kWorldKinds));
  auto* truth = command->add_option("--ground-truth", a->ground_truth,
                                    "write the true path of one robot to this text file: lines of time [s since 1970], "
                                    "x, y, z [m], yaw, pitch, roll [rad], as MRPT's pf-localization "
                                    "(ground_truth_path_file) and CPose3DInterpolator read them");
  truth->type_name("FILE")->check(fileName())->excludes(print)->excludes(sensor)->excludes(check)->excludes(controller);
  auto* output = command->add_option("--output", a->output,
                                     "write the selected observations to this rawlog, with embedded pictures");
  output->type_name("FILE")->check(fileName())->excludes(print)->excludes(truth)->excludes(check)->excludes(controller);
  for (auto* other : {controller, check, truth, output}) index->excludes(other);
  controller->excludes(print)->excludes(sensor)->excludes(from)->excludes(to);
  addObserverOption(*command, a->observers,
                    "repeat the run, check that it is identical, and print the metrics of this observer; in the "
                    "recorded world, or that of --check")
      ->excludes(print)
      ->excludes(index)
      ->excludes(controller)
      ->excludes(robot)
      ->excludes(sensor)
      ->excludes(from)
      ->excludes(to)
      ->excludes(truth)
      ->excludes(output);
  check->excludes(print)->excludes(controller)->excludes(robot)->excludes(sensor)->excludes(from)->excludes(to);
  command->add_flag("--json", a->json, "print the summary, or the observers' metrics, as one JSON object")
      ->excludes(print)
      ->excludes(controller)
      ->excludes(truth)
      ->excludes(output);
  index->excludes(addReadingThreads(*command, a->threads));
  setGroup(*command, kSelectionGroup, {"--robot", "--sensor", "--from", "--to"});
  setGroup(*command, "Output", {"--index", "--print", "--csv", "--speed", "--ground-truth", "--output", "--json"});
  setGroup(*command, "Repetition", {"--controller", "--tolerance", "--check", "--observer"});
  const std::string examples =
      "Try:  robosim replay run.rawlog --robot Pioneer1 --sensor laser --print --csv > laser.csv\n"
      "      robosim replay run.rawlog --robot Pioneer1 --sensor laser --sensor odometry --output slam.rawlog\n"
      "      robosim replay run.rawlog --observer \"coverage cell_m=0.25\"\n"
      "To view a recording: robosim view RAWLOG.\n"
      "Exit codes: 0 success, 1 bad input or a damaged recording, whose readable entries are used, 2 --check or\n"
      "--observer found a difference.\n\n";
  command->footer([examples] { return examples + controllersHelp(); });
  command->callback([a] {
    const ReplayResult result = replay(*a);
    if (result == ReplayResult::different) throw Exit{kRunFailed};
    if (result == ReplayResult::damaged) throw Exit{kBadInput};
  });
}

}  // namespace robosim
