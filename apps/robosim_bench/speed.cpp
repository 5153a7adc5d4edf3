#include <algorithm>
#include <iostream>
#include <type_traits>
#include <utility>

#include <CLI/CLI.hpp>

#include "base/interrupt.h"
#include "base/progress.h"
#include "base/text_table.h"
#include "base/vector_width.h"
#include "robosim/arguments.h"
#include "robosim_bench/benchmarks.h"
#include "robosim_bench/min_time.h"
#include "robosim_bench/process.h"
#include "robosim_bench/tables.h"
#include "robosim_bench/targets.h"

namespace robosim {
namespace {

constexpr const char* kRaysHelp =
    "laser scans and single rays among 1,000 solids, one thread, compared with Embree 3 if available";

constexpr const char* kEnkiHelp = "infrared robots, at most 1,000, one thread, compared with Enki if available";

constexpr std::pair<const char*, VectorWidth> kVectorWidths[] = {
    {"sse2", VectorWidth::sse2}, {"avx2", VectorWidth::avx2}, {"avx512", VectorWidth::avx512}};

std::vector<std::string> vectorWidthNames() {
  std::vector<std::string> names;
  for (const auto& [name, width] : kVectorWidths) names.emplace_back(name);
  return names;
}

VectorWidth vectorWidthNamed(const std::string& name) {
  const auto* found = std::find_if(std::begin(kVectorWidths), std::end(kVectorWidths),
                                   [&](const auto& known) { return name == known.first; });
  return found->second;
}

struct SpeedArguments {
  std::vector<std::size_t> robots;
  std::vector<std::string> workloads;
  std::vector<std::string> type_names;
  std::vector<Workload> types;  ///< of `type_names`
  int threads = 1;
  std::uint64_t seed = 1;
  double min_s = 1;
  bool json = false;
  std::string vectors;      ///< vector width to use; empty for the widest
  std::string write_world;  ///< folder; empty to measure
  bool targets = false;     ///< no selection was given, so everything is measured
};

std::vector<Workload> workloadsOfTypes(const std::vector<std::string>& names) {
  std::vector<Workload> types;
  for (const auto& name : names == std::vector<std::string>{"all"} ? robotTypeNames() : names)
    types.push_back(workloadOfType(name));
  return types;
}

bool isSelected(const SpeedArguments& arguments, const std::string& workload) {
  const auto& names = arguments.workloads;
  return (names.empty() && arguments.types.empty()) || std::find(names.begin(), names.end(), workload) != names.end();
}

std::vector<std::size_t> sizes(const SpeedArguments& arguments) {
  return arguments.robots.empty() ? std::vector<std::size_t>{100, 1000, 10000} : arguments.robots;
}

std::vector<RobotLoad> makeLoads(const SpeedArguments& arguments) {
  if (arguments.targets) return standardLoads();
  std::vector<RobotLoad> loads;
  const auto add = [&](const Workload& workload) {
    for (const auto robots : sizes(arguments)) loads.push_back({&workload, robots, arguments.threads});
  };
  for (const auto& workload : workloads()) {
    if (isSelected(arguments, workload.name)) add(workload);
  }
  for (const auto& type : arguments.types) add(type);
  return loads;
}

std::string textOf(const RobotLoad& load) {
  return load.workload->name + ", " + withCommas(load.robots) + " robots, " + std::to_string(load.threads) +
         (load.threads == 1 ? " thread" : " threads");
}

class SpeedBench {
 public:
  explicit SpeedBench(const SpeedArguments& arguments) : arguments_(arguments) {}

  /// Prints JSON lines as the figures arrive, if requested.
  SpeedFigures measure() {
    for (const auto& load : makeLoads(arguments_)) {
      figures_.loads.push_back(shown(textOf(load), [&] { return benchRobots(load, seed_, min_s_); }));
      if (arguments_.json) std::cout << toJson(figures_.loads.back()).dump() << std::endl;
    }
    if (isSelected(arguments_, kRays)) {
      figures_.rays = shown("rays compared with Embree", [&] { return benchRays(seed_, min_s_); });
      if (arguments_.json) {
        for (const auto& line : toJsonLines(figures_.rays)) std::cout << line.dump() << std::endl;
      }
    }
    if (isSelected(arguments_, kEnki)) {
      figures_.enki = shown("infrared compared with Enki", [&] { return benchEnki(sizes(arguments_), seed_, min_s_); });
      if (arguments_.json) {
        for (const auto& line : toJsonLines(figures_.enki)) std::cout << line.dump() << std::endl;
      }
    }
    if (arguments_.targets) measureRest();
    return std::move(figures_);
  }

 private:
  /// Figures needed for the targets only.
  void measureRest() {
    const Workload& sonar = workloadNamed("sonar");
    const Workload& sector = workloadNamed("sector");
    const auto compare = [&](const std::string& what, const RobotLoad& a, const RobotLoad& b) {
      return shown(what, [&] { return compareRobots({a, b}, seed_, min_s_); });
    };
    figures_.sonar_sector = compare("sector relative to sonar", {&sonar, kSome, 1}, {&sector, kSome, 1});
    figures_.some_many = compare("100,000 robots relative to 1,000", {&sonar, kSome, 1}, {&sonar, kMany, 1});
    figures_.one_two = compare("two threads relative to one", {&sonar, kMany, 1}, {&sonar, kMany, 2});
    figures_.some_loaded = shown("loading 1,000 robots", [&] { return benchLoading(sonar, kSome, seed_); });
    figures_.many_loaded = shown("loading 100,000 robots", [&] { return benchLoading(sonar, kMany, seed_); });
    figures_.small_run =
        shown("opho2_1 with and without recording", [&] { return benchRecording(smallRun(), min_s_); });
  }

  /// Measures, and shows a progress line with the subject.
  template <typename Measure>
  std::invoke_result_t<Measure> shown(const std::string& what, const Measure& measure) {
    Progress progress;
    if (progress.due()) progress.show(what + " …");
    auto figures = measure();
    if (interrupt_.isRequested()) throw Interrupted(kInterrupted);
    return figures;
  }

  const SpeedArguments& arguments_;
  const std::uint64_t seed_ = arguments_.seed;
  const double min_s_ = arguments_.min_s;
  const Interrupt interrupt_;  ///< ends the measuring process; this one then removes its files
  SpeedFigures figures_;
};

void print(const SpeedFigures& figures, bool with_targets) {
  if (!figures.loads.empty()) std::cout << toTable(figures.loads) << '\n';
  if (!figures.rays.figures.empty()) std::cout << toTable(figures.rays) << '\n';
  if (!figures.enki.figures.empty() || !figures.enki.why_no_peer.empty()) std::cout << toTable(figures.enki) << '\n';
  if (with_targets) std::cout << toTable(readTargets(figures)) << '\n';
}

void benchSpeed(const SpeedArguments& arguments) {
  if (!arguments.write_world.empty()) {
    const auto loads = makeLoads(arguments);
    if (arguments.workloads.size() + arguments.types.size() != 1 || loads.size() != 1)
      throw std::invalid_argument("--write-world: give one --workload or --robot-type, and one --robots");
    std::cout << writeWorld(arguments.write_world, *loads[0].workload, loads[0].robots, arguments.seed).string()
              << std::endl;
    return;
  }
  if (!arguments.vectors.empty()) setVectorWidth(vectorWidthNamed(arguments.vectors));
  const OtherLoad other_load;
  const SpeedFigures figures = SpeedBench(arguments).measure();
  if (arguments.json) return;
  print(figures, arguments.targets);
  std::cout << "Other programs used " << fixed(other_load.processors(), 1) << " of " << OtherLoad::ofProcessors()
            << " processors during the measurement, which affects wall times.\n";
}

}  // namespace

void addSpeedBenchmark(CLI::App& program) {
  auto* command = program.add_subcommand("speed", "Measure robot-steps per second on standard workloads");
  auto a = std::make_shared<SpeedArguments>();
  std::vector<std::string> names;
  Rows rows;
  for (const auto& workload : workloads()) {
    names.emplace_back(workload.name);
    rows.push_back({std::string("  ") + workload.name, workload.help});
  }
  names.emplace_back(kRays);
  rows.push_back({std::string("  ") + kRays, kRaysHelp});
  names.emplace_back(kEnki);
  rows.push_back({std::string("  ") + kEnki, kEnkiHelp});
  std::vector<CLI::Option*> choices;
  choices.push_back(command
                        ->add_option("--robots", a->robots,
                                     "number of robots, 1 to 10000000; repeatable; default: 100, 1,000 and 10,000")
                        ->check(wholeNumberIn(1, 10000000))
                        ->type_name("NUMBER"));
  choices.push_back(command->add_option("--workload", a->workloads, "name of a workload; repeatable; default: all")
                        ->check(CLI::IsMember(names)));
  choices.push_back(command
                        ->add_option("--robot-type", a->type_names,
                                     "name of a robot type in place of a workload, or all; repeatable; default: none")
                        ->type_name("TYPE"));
  choices.push_back(command->add_option("--threads", a->threads, "threads to step with, 1 to 1024")
                        ->check(wholeNumberIn(1, 1024))
                        ->type_name("NUMBER")
                        ->capture_default_str());
  choices.push_back(command->add_flag("--json", a->json, "print one JSON object per line"));
  command->add_option("--vectors", a->vectors, "width of RoboSim's vectors: sse2, avx2 or avx512; default: the widest")
      ->check(CLI::IsMember(vectorWidthNames()));
  command->add_option("--seed", a->seed, "seed of the worlds")->check(seedNumber())->capture_default_str();
  addMinTime(*command, "each", a->min_s);
  command
      ->add_option("--write-world", a->write_world,
                   "write the world of one workload into this folder, for ranks.py, "
                   "and measure nothing")
      ->type_name("FOLDER");
  command->footer("Workloads:\n" + listing(rows) +
                  "Without --robots, --workload, --robot-type, --threads and --json all figures for the speed targets "
                  "are measured,\n"
                  "including 100,000 robots and two threads, and the targets are evaluated (doc/performance.md).");
  command->callback([a, choices] {
    a->targets = std::none_of(choices.begin(), choices.end(), [](const CLI::Option* o) { return o->count() > 0; });
    a->types = workloadsOfTypes(a->type_names);
    benchSpeed(*a);
  });
}

}  // namespace robosim
