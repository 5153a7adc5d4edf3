#include <algorithm>
#include <iostream>

#include <nlohmann/json.hpp>

#include "robosim/arguments.h"
#include "robosim/bench_targets.h"
#include "robosim/interrupt.h"
#include "robosim/progress.h"
#include "robosim/subcommands.h"
#include "robosim/text.h"

namespace robosim {
namespace {

constexpr const char* kRays = "rays";
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

/// What is measured next, where a person looks.
void show(const std::string& what) {
  Progress progress;
  if (progress.due()) progress.show(what + " …");
}

std::vector<RobotLoad> loadsOf(const Arguments& arguments) {
  if (arguments.targets) return standardLoads();
  std::vector<RobotLoad> loads;
  for (const auto& workload : workloads()) {
    const auto& names = arguments.workloads;
    if (!names.empty() && std::find(names.begin(), names.end(), workload.name) == names.end()) continue;
    const auto sizes = arguments.robots.empty() ? std::vector<std::size_t>{100, 1000, 10000} : arguments.robots;
    for (const auto robots : sizes) loads.push_back({&workload, robots, arguments.threads});
  }
  return loads;
}

double raysPerSecond(const RobotFigures& f) {
  return static_cast<double>(workloadNamed(f.workload).rays) / f.robot_step.wall_s;
}

/// The fields that every line has.
nlohmann::ordered_json line(const std::string& workload, std::size_t robots, int threads, const Cost& robot_step,
                            double rays_per_s, double peak_rss_mb) {
  return {{"workload", workload},      {"robots", robots},
          {"threads", threads},        {"robot_steps_per_s", 1 / robot_step.wall_s},
          {"rays_per_s", rays_per_s},  {"cpu_s_per_robot_step", robot_step.cpu_s},
          {"peak_rss_mb", peak_rss_mb}};
}

void printLine(const RobotFigures& f) {
  auto json = line(f.workload, f.robots, f.threads, f.robot_step, raysPerSecond(f), f.peak_rss_mb);
  json["make_s"] = f.make_s;
  json["digest"] = f.digest;
  std::cout << json.dump() << std::endl;
}

/// A place that 181 rays are cast from counts as a robot, and casting them as its step.
void printLines(const RayBench& bench) {
  for (const auto& f : bench.figures) {
    const Cost place{f.ray.wall_s * RayFigures::kRaysPerPlace, f.ray.cpu_s * RayFigures::kRaysPerPlace};
    auto json = line(kRays, f.places, 1, place, 1 / f.ray.wall_s, bench.peak_rss_mb);
    json["cast"] = f.what;
    json["range_m"] = f.range_m;
    if (!bench.peer.empty()) {
      json["peer"] = bench.peer;
      json["peer_rays_per_s"] = 1 / f.peer_ray.wall_s;
      json["times_peer"] = f.ratio();
    }
    std::cout << json.dump() << std::endl;
  }
}

std::string loadTable(const std::vector<RobotFigures>& loads) {
  Rows rows{
      {"workload", "robots", "threads", "robot-steps/s", "Mrays/s", "CPU µs/robot-step", "peak MB", "made in [s]"}};
  for (const auto& f : loads) {
    rows.push_back({f.workload, withCommas(f.robots), std::to_string(f.threads),
                    withCommas(static_cast<std::uint64_t>(1 / f.robot_step.wall_s)),
                    raysPerSecond(f) > 0 ? fixed(raysPerSecond(f) * 1e-6, 1) : "–", fixed(f.robot_step.cpu_s * 1e6, 2),
                    fixed(f.peak_rss_mb, 0), fixed(f.make_s, 2)});
  }
  return table(rows);
}

std::string rayTable(const RayBench& bench) {
  const bool peer = !bench.peer.empty();
  Rows rows{{"rays, one thread", "Mrays/CPU s", peer ? bench.peer : "", peer ? "ratio" : "", ""}};
  for (const auto& f : bench.figures) {
    rows.push_back({f.what + " to " + fixed(f.range_m, 0) + " m", fixed(1e-6 / f.ray.cpu_s, 1)});
    if (peer)
      rows.back().insert(rows.back().end(), {fixed(1e-6 / f.peer_ray.cpu_s, 1), fixed(f.ratio(), 2), f.peer_call});
  }
  return table(rows) + withCommas(bench.answers) + (peer ? " answers of each" : " answers") + " are brute force's.\n" +
         (peer ? "" : "Not beside Embree 3: " + bench.why_no_peer + ".\n");
}

std::string targetTable(const std::vector<Target>& targets) {
  Rows rows{{"target", "wanted", "measured", "met"}};
  for (const auto& t : targets) rows.push_back({t.what, t.wanted, t.measured, t.met ? (*t.met ? "yes" : "no") : "–"});
  return table(rows);
}

/// What only the targets need.
void measureRest(const Arguments& arguments, SpeedFigures& figures) {
  const Workload& sonar = workloadNamed("sonar");
  const Workload& sector = workloadNamed("sector");
  const auto compare = [&](const RobotLoad& a, const RobotLoad& b) {
    return compareRobots({a, b}, arguments.seed, arguments.least_s);
  };
  show("sector beside sonar, 1,000 robots");
  figures.sonar_sector = compare({&sonar, kSome, 1}, {&sector, kSome, 1});
  show("100,000 robots beside 1,000");
  figures.some_many = compare({&sonar, kSome, 1}, {&sonar, kMany, 1});
  show("two threads beside one, 100,000 robots");
  figures.one_two = compare({&sonar, kMany, 1}, {&sonar, kMany, 2});
  show("loading 100,000 robots");
  figures.some_loaded = benchLoading(sonar, kSome, arguments.seed);
  figures.many_loaded = benchLoading(sonar, kMany, arguments.seed);
  show("opho2_1 with and without recording");
  figures.small_run = benchSmallRun(arguments.least_s);
}

void benchSpeed(const Arguments& arguments) {
  for (const auto& name : arguments.workloads) {
    if (name != kRays) workloadNamed(name);
  }
  const auto& names = arguments.workloads;
  const bool with_rays = names.empty() || std::find(names.begin(), names.end(), kRays) != names.end();
  const Interrupt interrupt;  // what is measured dies of it; this process then puts away the worlds' files
  SpeedFigures figures;

  for (const auto& load : loadsOf(arguments)) {
    show(std::string(load.workload->name) + ", " + withCommas(load.robots) + " robots, " +
         std::to_string(load.threads) + (load.threads == 1 ? " thread" : " threads"));
    figures.loads.push_back(benchRobots(load, arguments.seed, arguments.least_s));
    if (arguments.json) printLine(figures.loads.back());
  }
  if (with_rays) {
    show("rays beside Embree");
    figures.rays = benchRays(arguments.seed, arguments.least_s);
    if (arguments.json) printLines(figures.rays);
  }
  if (arguments.json) return;
  if (!figures.loads.empty()) std::cout << loadTable(figures.loads);
  if (with_rays) std::cout << (figures.loads.empty() ? "" : "\n") << rayTable(figures.rays);
  if (!arguments.targets) return;

  measureRest(arguments, figures);
  std::cout << '\n' << targetTable(targetsOf(figures));
}

}  // namespace

void addBenchSpeed(CLI::App& bench) {
  auto* command = bench.add_subcommand("speed", "How many robots it steps a second, on standard workloads");
  auto a = std::make_shared<Arguments>();
  std::vector<CLI::Option*> choices;
  choices.push_back(
      command->add_option("--robots", a->robots, "how many; may be given several times; without: 100, 1,000 and 10,000")
          ->check(CLI::Range(1, 10000000)));
  choices.push_back(
      command->add_option("--workload", a->workloads, "which; may be given several times; all of them without"));
  choices.push_back(
      command->add_option("--threads", a->threads, "to step with")->check(CLI::Range(1, 1024))->capture_default_str());
  choices.push_back(command->add_flag("--json", a->json, "print one JSON object a line"));
  command->add_option("--seed", a->seed, "of the worlds")->check(seedNumber())->capture_default_str();
  command->add_option("--at-least", a->least_s, "seconds to measure each for")
      ->check(numberIn(1e-6, 3600))
      ->type_name("SECONDS")
      ->capture_default_str();
  Rows rows;
  for (const auto& workload : workloads()) rows.push_back({std::string("  ") + workload.name, workload.help});
  rows.push_back({std::string("  ") + kRays, kRaysHelp});
  command->footer("Workloads:\n" + listing(rows) +
                  "Without --robots, --workload, --threads and --json it measures all that RoboSim wants to reach in\n"
                  "speed, 100,000 robots and two threads too, and says what is reached (doc/performance.md).");
  command->callback([a, choices] {
    a->targets = std::none_of(choices.begin(), choices.end(), [](const CLI::Option* o) { return o->count() > 0; });
    benchSpeed(*a);
  });
}

}  // namespace robosim
