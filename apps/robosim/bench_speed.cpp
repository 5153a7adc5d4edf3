#include <chrono>
#include <iostream>

#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "robosim/arguments.h"
#include "robosim/local_run.h"
#include "robosim/progress.h"
#include "robosim/subcommands.h"
#include "robosim/text.h"
#include "robosim/workloads.h"

namespace robosim {
namespace {

struct Arguments {
  std::vector<std::size_t> robots{100, 1000, 10000};
  std::vector<std::string> workloads;
  int threads = 1;
  std::uint64_t seed = 1;
  double least_s = 1;
  bool json = false;
};

/// What one workload cost.
struct Figures {
  const Workload* workload = nullptr;
  std::size_t robots = 0;
  double robot_steps_per_s = 0;
  double rays_per_s = 0;
  double cpu_s_per_robot_step = 0;
  double peak_rss_mb = 0;
  double load_s = 0;
  std::string digest;  ///< after the warm-up, of a fixed length
};

struct Usage {
  std::chrono::steady_clock::time_point wall = std::chrono::steady_clock::now();
  double cpu_s = 0;
  double peak_rss_mb = 0;

  static Usage now() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    Usage u;
    u.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    u.peak_rss_mb = static_cast<double>(usage.ru_maxrss) / 1024;
    return u;
  }
};

double between(const Usage& from, const Usage& to) {
  return std::chrono::duration<double>(to.wall - from.wall).count();
}

Figures measure(const Workload& workload, std::size_t robots, const Arguments& arguments) {
  const Usage before = Usage::now();
  RunOptions options;
  options.environment = {.seed = arguments.seed, .period_s = 0.1, .threads = arguments.threads};
  LocalRun run(makeWorld(workload, robots, arguments.seed), options);
  const Usage loaded = Usage::now();

  // The first steps fill caches, and bring the robots up to speed.
  constexpr int kWarmUpSteps = 20;
  for (int i = 0; i < kWarmUpSteps; ++i) run.step();
  const std::string digest = run.environment().digest();
  const Usage start = Usage::now();
  Usage end = start;
  double steps = 0;
  do {
    for (int i = 0; i < 10; ++i) run.step();
    steps += 10;
    end = Usage::now();
  } while (between(start, end) < arguments.least_s);

  const double robot_steps = steps * static_cast<double>(robots);
  const double wall_s = between(start, end);
  return {.workload = &workload,
          .robots = robots,
          .robot_steps_per_s = robot_steps / wall_s,
          .rays_per_s = robot_steps * static_cast<double>(workload.rays) / wall_s,
          .cpu_s_per_robot_step = (end.cpu_s - start.cpu_s) / robot_steps,
          .peak_rss_mb = end.peak_rss_mb,
          .load_s = between(before, loaded),
          .digest = digest};
}

nlohmann::ordered_json json(const Figures& f, int threads) {
  return {{"workload", f.workload->name},
          {"robots", f.robots},
          {"threads", threads},
          {"robot_steps_per_s", f.robot_steps_per_s},
          {"rays_per_s", f.rays_per_s},
          {"cpu_s_per_robot_step", f.cpu_s_per_robot_step},
          {"peak_rss_mb", f.peak_rss_mb},
          {"load_s", f.load_s},
          {"digest", f.digest}};
}

void benchSpeed(const Arguments& arguments) {
  std::vector<std::string> names = arguments.workloads;
  if (names.empty()) {
    for (const auto& workload : workloads()) names.emplace_back(workload.name);
  }
  for (const auto& name : names) workloadNamed(name);

  Rows rows{
      {"workload", "robots", "threads", "robot-steps/s", "Mrays/s", "CPU µs/robot-step", "peak MB", "made in [s]"}};
  for (const auto& name : names) {
    for (const auto robots : arguments.robots) {
      {
        Progress progress;
        if (progress.due()) progress.show(name + ", " + withCommas(robots) + " robots …");
      }
      const Figures f = measure(workloadNamed(name), robots, arguments);
      if (arguments.json) {
        std::cout << json(f, arguments.threads).dump() << std::endl;
        continue;
      }
      rows.push_back({name, withCommas(robots), std::to_string(arguments.threads),
                      withCommas(static_cast<std::uint64_t>(f.robot_steps_per_s)),
                      f.rays_per_s > 0 ? fixed(f.rays_per_s * 1e-6, 1) : "–", fixed(f.cpu_s_per_robot_step * 1e6, 2),
                      fixed(f.peak_rss_mb, 0), fixed(f.load_s, 2)});
    }
  }
  if (!arguments.json) std::cout << table(rows);
}

}  // namespace

void addBenchSpeed(CLI::App& bench) {
  auto* command = bench.add_subcommand("speed", "How many robots it steps a second, on standard workloads");
  auto a = std::make_shared<Arguments>();
  command->add_option("--robots", a->robots, "how many; may be given several times")
      ->check(CLI::Range(1, 10000000))
      ->capture_default_str();
  command->add_option("--workload", a->workloads, "which; may be given several times; all of them without");
  command->add_option("--threads", a->threads, "to step with")->check(CLI::Range(1, 1024))->capture_default_str();
  command->add_option("--seed", a->seed, "of the worlds")->check(seedNumber())->capture_default_str();
  command->add_option("--at-least", a->least_s, "seconds to measure each for")
      ->check(numberIn(1e-6, 3600))
      ->type_name("SECONDS")
      ->capture_default_str();
  command->add_flag("--json", a->json, "print one JSON object a line");
  std::string footer = "Workloads:\n";
  Rows rows;
  for (const auto& workload : workloads()) rows.push_back({std::string("  ") + workload.name, workload.help});
  command->footer(footer + listing(rows));
  command->callback([a] { benchSpeed(*a); });
}

}  // namespace robosim
