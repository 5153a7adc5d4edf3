#include <algorithm>
#include <iostream>
#include <type_traits>

#include <CLI/CLI.hpp>

#include "robosim/arguments.h"
#include "robosim/bench_process.h"
#include "robosim/bench_tables.h"
#include "robosim/bench_targets.h"
#include "robosim/interrupt.h"
#include "robosim/progress.h"
#include "robosim/subcommands.h"
#include "robosim/text.h"

namespace robosim {
namespace {

constexpr const char* kRaysHelp =
    "laser scans and single rays among 1,000 solids, one thread, beside Embree 3 where built in";

struct Arguments {
  std::vector<std::size_t> robots;
  std::vector<std::string> workloads;
  int threads = 1;
  std::uint64_t seed = 1;
  double least_s = 1;
  bool json = false;
  bool targets = false;  ///< nothing was asked for in particular, so everything is measured
};

bool wants(const Arguments& arguments, const std::string& workload) {
  const auto& names = arguments.workloads;
  return names.empty() || std::find(names.begin(), names.end(), workload) != names.end();
}

std::vector<RobotLoad> loadsOf(const Arguments& arguments) {
  if (arguments.targets) return standardLoads();
  const auto sizes = arguments.robots.empty() ? std::vector<std::size_t>{100, 1000, 10000} : arguments.robots;
  std::vector<RobotLoad> loads;
  for (const auto& workload : workloads()) {
    if (!wants(arguments, workload.name)) continue;
    for (const auto robots : sizes) loads.push_back({&workload, robots, arguments.threads});
  }
  return loads;
}

std::string textOf(const RobotLoad& load) {
  return std::string(load.workload->name) + ", " + withCommas(load.robots) + " robots, " +
         std::to_string(load.threads) + (load.threads == 1 ? " thread" : " threads");
}

class SpeedBench {
 public:
  explicit SpeedBench(const Arguments& arguments) : arguments_(arguments) {}

  /// Prints lines for a program meanwhile, if those are what is wanted.
  SpeedFigures measure() {
    for (const auto& load : loadsOf(arguments_)) {
      figures_.loads.push_back(shown(textOf(load), [&] { return benchRobots(load, seed_, least_s_); }));
      if (arguments_.json) std::cout << lineOf(figures_.loads.back()).dump() << std::endl;
    }
    if (wants(arguments_, kRays)) {
      figures_.rays = shown("rays beside Embree", [&] { return benchRays(seed_, least_s_); });
      if (arguments_.json) {
        for (const auto& line : linesOf(figures_.rays)) std::cout << line.dump() << std::endl;
      }
    }
    if (arguments_.targets) measureRest();
    return std::move(figures_);
  }

 private:
  /// What only the targets need.
  void measureRest() {
    const Workload& sonar = workloadNamed("sonar");
    const Workload& sector = workloadNamed("sector");
    const auto compare = [&](const std::string& what, const RobotLoad& a, const RobotLoad& b) {
      return shown(what, [&] { return compareRobots({a, b}, seed_, least_s_); });
    };
    figures_.sonar_sector = compare("sector beside sonar", {&sonar, kSome, 1}, {&sector, kSome, 1});
    figures_.some_many = compare("100,000 robots beside 1,000", {&sonar, kSome, 1}, {&sonar, kMany, 1});
    figures_.one_two = compare("two threads beside one", {&sonar, kMany, 1}, {&sonar, kMany, 2});
    figures_.some_loaded = shown("loading 1,000 robots", [&] { return benchLoading(sonar, kSome, seed_); });
    figures_.many_loaded = shown("loading 100,000 robots", [&] { return benchLoading(sonar, kMany, seed_); });
    figures_.small_run = shown("opho2_1 with and without recording", [&] { return benchSmallRun(least_s_); });
  }

  /// Measures, and shows meanwhile what.
  template <typename Measure>
  std::invoke_result_t<Measure> shown(const std::string& what, const Measure& measure) {
    Progress progress;
    if (progress.due()) progress.show(what + " …");
    auto figures = measure();
    if (interrupt_.asked()) throw std::runtime_error(kInterrupted);
    return figures;
  }

  const Arguments& arguments_;
  const std::uint64_t seed_ = arguments_.seed;
  const double least_s_ = arguments_.least_s;
  const Interrupt interrupt_;  ///< it ends the process that measures; this one then puts away its files
  SpeedFigures figures_;
};

void print(const SpeedFigures& figures, bool with_targets) {
  if (!figures.loads.empty()) std::cout << tableOf(figures.loads) << '\n';
  if (!figures.rays.figures.empty()) std::cout << tableOf(figures.rays) << '\n';
  if (with_targets) std::cout << tableOf(targetsOf(figures)) << '\n';
}

void benchSpeed(const Arguments& arguments) {
  const Company company;
  const SpeedFigures figures = SpeedBench(arguments).measure();
  if (arguments.json) return;
  print(figures, arguments.targets);
  std::cout << "Other programs kept " << fixed(company.processors(), 1) << " of " << Company::ofProcessors()
            << " processors busy meanwhile; the more, the worse are figures by the clock.\n";
}

}  // namespace

void addBenchSpeed(CLI::App& bench) {
  auto* command = bench.add_subcommand("speed", "How many robots it steps a second, on standard workloads");
  auto a = std::make_shared<Arguments>();
  std::vector<std::string> names;
  Rows rows;
  for (const auto& workload : workloads()) {
    names.emplace_back(workload.name);
    rows.push_back({std::string("  ") + workload.name, workload.help});
  }
  names.emplace_back(kRays);
  rows.push_back({std::string("  ") + kRays, kRaysHelp});
  std::vector<CLI::Option*> choices;
  choices.push_back(
      command->add_option("--robots", a->robots, "how many; may be given several times; without: 100, 1,000 and 10,000")
          ->check(CLI::Range(1, 10000000)));
  choices.push_back(
      command->add_option("--workload", a->workloads, "which; may be given several times; all of them without")
          ->check(CLI::IsMember(names)));
  choices.push_back(
      command->add_option("--threads", a->threads, "to step with")->check(CLI::Range(1, 1024))->capture_default_str());
  choices.push_back(command->add_flag("--json", a->json, "print one JSON object a line"));
  command->add_option("--seed", a->seed, "of the worlds")->check(seedNumber())->capture_default_str();
  command->add_option("--at-least", a->least_s, "seconds to measure each for")
      ->check(numberIn(1e-6, 3600))
      ->type_name("SECONDS")
      ->capture_default_str();
  command->footer("Workloads:\n" + listing(rows) +
                  "Without --robots, --workload, --threads and --json it measures all that RoboSim wants to reach in\n"
                  "speed, 100,000 robots and two threads too, and says what is reached (doc/performance.md).");
  command->callback([a, choices] {
    a->targets = std::none_of(choices.begin(), choices.end(), [](const CLI::Option* o) { return o->count() > 0; });
    benchSpeed(*a);
  });
}

}  // namespace robosim
