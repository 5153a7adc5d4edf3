#include <iostream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "base/progress.h"
#include "base/text_table.h"
#include "robosim/arguments.h"
#include "robosim_bench/benchmarks.h"
#include "robosim_bench/min_time.h"
#include "robosim_bench/rounds.h"
#include "robosim_bench/workloads.h"
#include "run/local_run.h"
#include "viewing/view_outputs.h"

namespace robosim {
namespace {

struct Kind {
  const char* name;
  const char* help;
  bool is_2d, is_3d;
  ViewLayers layers = {};
  Panes::Look look = {};
};
const ViewLayers kNoLayers{.paths = false, .sensors = false, .names = false};
const ViewLayers kPaths{.sensors = false, .names = false};
const ViewLayers kRanges{.paths = false, .names = false};
const ViewLayers kNames{.paths = false, .sensors = false};
const Kind kKinds[] = {{"2d", "from above, with paths, sonar fans and names", true, false},
                       {"2d-bare", "from above, robots and objects only", true, false, kNoLayers},
                       {"2d-paths", "… with paths", true, false, kPaths},
                       {"2d-ranges", "… with sonar fans", true, false, kRanges},
                       {"2d-names", "… with names", true, false, kNames},
                       {"2d-inset", "… with a camera picture", true, false, kNoLayers, {.camera_inset = true}},
                       {"3d", "3D view, robots and objects only", false, true, kNoLayers},
                       {"3d-paths", "… with paths", false, true, kPaths},
                       {"3d-ranges", "… with sonar fans of the followed robot", false, true, kRanges},
                       {"3d-names", "… with names", false, true, kNames},
                       {"3d-inset", "… with a camera picture", false, true, kNoLayers, {.camera_inset = true}},
                       {"3d-antialias", "… antialiased", false, true, kNoLayers, {.antialias = true}},
                       {"both", "both side by side", true, true}};
constexpr double kAimFramesPerS = 20;

struct ViewArguments {
  std::size_t robots = 1000;
  double min_s = 2;
  bool json = false;
};

constexpr Size kSize{1280, 800};
constexpr std::uint64_t kPathSteps = 200;

/// A run in this process with a view updated step by step.
class RunView final : public ViewSource {
 public:
  RunView(LoadedWorld world, std::size_t robots)
      : title_(withCommas(robots) + " robots"), world_(world), run_(std::move(world), {}) {
    // A camera of the view only: the run does not render its pictures.
    SensorInfo camera;
    camera.kind = SensorKind::camera;
    camera.camera.width_px = 320;
    camera.camera.height_px = 240;
    camera.beams.emplace_back().robot_from_beam.z = 0.3;
    auto sensors = *world_.fleet.robots.front().info.sensors;
    sensors.push_back(camera);
    world_.fleet.robots.front().info.sensors = std::make_shared<const std::vector<SensorInfo>>(std::move(sensors));
  }

  const LoadedWorld& world() const override { return world_; }
  const RunSnapshot& snapshot() const override { return snapshot_; }
  const RunPaths& paths() const override { return paths_; }
  std::string title() const override { return title_; }
  bool advance(double) override {
    run_.step();
    snapshot_ = takeSnapshot(run_.environment());
    snapshot_.robots.front().readings->measurements.emplace_back();  // of that camera
    // Paths of bounded length: each view is measured at the same lengths, however many there are.
    if (snapshot_.step % kPathSteps == 0) paths_.clear();
    paths_.add(snapshot_);
    return true;
  }
  bool isOver() const override { return false; }

 private:
  std::string title_;
  LoadedWorld world_;
  LocalRun run_;
  RunSnapshot snapshot_;
  RunPaths paths_;
};

std::vector<Pane> makePanes(const Kind& kind, const World& world) {
  std::vector<Pane> panes;
  if (kind.is_2d) panes.push_back(makePane(false, std::nullopt, world));
  if (kind.is_3d) panes.push_back(makePane(true, std::nullopt, world));
  return panes;
}

void benchView(const ViewArguments& arguments) {
  RunView source(makeWorldToRun(workloadNamed("sonar"), arguments.robots, 1), arguments.robots);
  std::vector<std::unique_ptr<ViewDrawing>> drawings;
  std::vector<Contender> contenders;
  for (const Kind& kind : kKinds) {
    drawings.push_back(std::make_unique<ViewDrawing>(
        source, [&kind](const LoadedWorld& world, AbsentRobots) { return makePanes(kind, world.world); }));
    drawings.back()->panes().layers() = kind.layers;
    drawings.back()->panes().look() = kind.look;
    contenders.push_back({.work = [&source, &drawing = *drawings.back()] {
      source.advance(0);
      drawing.draw(kSize);
      return 1.0;
    }});
  }
  std::vector<Cost> costs;
  {
    Progress progress;
    if (progress.due()) progress.show("views of " + withCommas(arguments.robots) + " robots …");
    costs = measureAlternately(contenders, arguments.min_s);
  }
  Rows rows{{"view", "frames/s", "target", "CPU time per frame, ms", ""}};
  for (std::size_t i = 0; i < std::size(kKinds); ++i) {
    if (arguments.json) {
      std::cout << nlohmann::ordered_json{{"view", kKinds[i].name},
                                          {"robots", arguments.robots},
                                          {"frames_per_s", 1 / costs[i].wall_s},
                                          {"cpu_s_per_frame", costs[i].cpu_s}}
                       .dump()
                << std::endl;
    }
    rows.push_back({kKinds[i].name, fixed(1 / costs[i].wall_s, 1), fixed(kAimFramesPerS, 0),
                    fixed(1000 * costs[i].cpu_s, 1), kKinds[i].help});
  }
  if (!arguments.json) std::cout << table(rows);
}

}  // namespace

void addViewBenchmark(CLI::App& program) {
  auto* command = program.add_subcommand("view", "Measure the frame rate of a view of many robots");
  auto a = std::make_shared<ViewArguments>();
  command->add_option("--robots", a->robots, "number of robots, 1 to 1000000")
      ->check(wholeNumberIn(1, 1000000))
      ->type_name("NUMBER")
      ->capture_default_str();
  addMinTime(*command, "each view", a->min_s);
  command->add_flag("--json", a->json, "print one JSON object per line");
  command->footer(
      "The robots run 'wander' with 16 sonars each; a frame has 1280 × 800 pixels and shows the next step, with\n"
      "paths of up to 20 s. The time includes the environment's step and drawing, by a software renderer if there is\n"
      "no graphics card.");
  command->callback([a] { benchView(*a); });
}

}  // namespace robosim
