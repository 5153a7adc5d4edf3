#include "robosim/run_arguments.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "base/file_kind.h"
#include "base/text_table.h"
#include "maze/controllers.h"
#include "robosim/arguments.h"
#include "robosim/command_line.h"
#include "robosim/figure_arguments.h"
#include "robosim/subcommands.h"

namespace robosim {

namespace {

/// The layers of the picture, and of the window of a command that has --view.
void addPictureLayers(CLI::App& command, RunArguments& a) {
  auto layers = std::make_shared<LayerArguments>();
  const auto has_window = [&command] {
    const CLI::Option* const view = command.get_option_no_throw(std::string(kViewOption));
    return view && view->count() > 0;
  };
  for (CLI::Option* const option : layers->addTo(command)) {
    dependsOn(option, command.get_name() == "run" ? "--picture or --view" : "--picture",
              [&a, has_window] { return !a.picture.empty() || has_window(); });
  }
  command.parse_complete_callback([layers, &a, has_window] {
    if (has_window()) {
      std::vector<std::string> drawn = windowLayers();
      if (!a.picture.empty()) drawn = figureLayers();
      layers->check("a window", drawn);
    } else if (!a.picture.empty()) {
      layers->check("a plan of a run", planLayers());
    }
    a.layers = layers->layers();
    a.only = layers->only();
  });
}

}  // namespace

void addRunArguments(CLI::App& command, RunArguments& a) {
  command
      .add_option("WORLD", a.world,
                  "world file, also of Stage (.world), or map file; a shipped one also by name alone: maze_20x20")
      ->type_name("FILE")
      ->transform(inputFile(kWorldKinds))
      ->required();
  addRobotOptions(command, a.changes);
  addRandomStartsOption(command, a.changes);
  addNoiseOption(command, a.changes);
  addSeedOption(command, a.run.environment.seed, "seed of all random numbers: noise, random starts, controllers");
  auto* record = command
                     .add_option("--record", a.record,
                                 "record the run to this file, as an MRPT rawlog or, if it ends in .mcap, as "
                                 "MCAP with topics of ROS 2")
                     ->type_name("FILE")
                     ->check(fileName())
                     ->group(kRecordingGroup);
  auto* format = command
                     .add_option("--rawlog-format", a.rawlog_format,
                                 "obs: observations; sf: pairs of action and sensory frame, one file per robot")
                     ->check(CLI::IsMember({"obs", "sf"}))
                     ->capture_default_str()
                     ->group(kRecordingGroup);
  dependsOn(format, record);
  auto* images =
      command
          .add_option("--record-images", a.record_images,
                      "camera pictures: embedded in the rawlog, or external, as JPEG files in the folder STEM_Images")
          ->check(CLI::IsMember({"embedded", "external"}))
          ->capture_default_str()
          ->group(kRecordingGroup);
  dependsOn(images, record);
  dependsOn(addDistributionOption(command, a.distribution)->group(kRecordingGroup), "--ros2, or --record FILE.mcap",
            [&command, &a] {
              const CLI::Option* const ros2 = command.get_option_no_throw("--ros2");
              return isMcapName(a.record) || (ros2 && ros2->count() > 0);
            });
  addTime(command, a.time_s, "simulated time limit; the run ends earlier if all robots have halted");
  addStep(command, a.run.environment.period_s);
  addThreads(command, a.run.environment.threads, "number of threads; the run does not depend on it");
  command.add_option("--speed", a.speed, "simulated seconds per second: max, or 0.001 to 1000000 (1 is real time)")
      ->type_name("X|max")
      ->capture_default_str()
      ->group(kRunGroup);
  addControllerOption(command, a.run.controller, "controller of all robots, instead of those in the world")
      ->group(kRunGroup);
  addObserverOption(command, a.run.observers, "watch the run with this observer: metrics, an end of its own, a log")
      ->group(kRunGroup);
  command
      .add_option("--picture", a.picture,
                  "draw the world from above, with the paths of all robots, to this PNG, SVG or PDF file")
      ->type_name("FILE")
      ->check(fileName())
      ->group(kRecordingGroup);
  addPictureLayers(command, a);
  command.add_flag("--json", a.json, "print the summary as one JSON object")->group(kRecordingGroup);
}

void checkRunArguments(const RunArguments& a) {
  speedNumber(a.speed);
  checkObservers(a.run.observers);
  warnOfPartialStep(a.time_s, a.run.environment.period_s);
  refuseSameFile({{"WORLD", a.world}, {"--record", a.record}, {"--picture", a.picture}});
}

std::string controllersHelp() {
  std::string text = "Controllers:\n";
  Rows rows;
  for (const auto& type : controllers().types()) rows.push_back({"  " + type.name, type.help});
  return text + listing(rows) + "Their parameters:  robosim controllers";
}

}  // namespace robosim
