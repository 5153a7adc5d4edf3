#include "robosim_bench/targets.h"

#include <algorithm>
#include <cmath>

#include "base/text_table.h"

namespace robosim {
namespace {

/// Index of the figures of all loads.
class Loads {
 public:
  explicit Loads(const std::vector<RobotFigures>& all) : all_(all) {}
  const RobotFigures& operator()(const std::string& workload, std::size_t robots, int threads) const {
    return *std::find_if(all_.begin(), all_.end(), [&](const RobotFigures& f) {
      return f.workload == workload && f.robots == robots && f.threads == threads;
    });
  }

 private:
  const std::vector<RobotFigures>& all_;
};

std::string numberText(double value, int digits) {
  return digits == 0 ? withCommas(static_cast<std::uint64_t>(std::llround(value))) : fixed(value, digits);
}

/// A number with a fixed number of digits and a unit.
struct Figure {
  double value;
  int digits;
  const char* unit;
  std::string text(double of) const { return numberText(of, digits) + " " + unit; }
};

class TargetList {
 public:
  void atLeast(double target, const std::string& what, const Figure& f) {
    targets_.push_back({what, "≥ " + f.text(target), f.text(f.value), f.value >= target});
  }
  void atMost(double target, const std::string& what, const Figure& f) {
    targets_.push_back({what, "≤ " + f.text(target), f.text(f.value), f.value <= target});
  }
  void add(Target target) { targets_.push_back(std::move(target)); }
  std::vector<Target> take() { return std::move(targets_); }

 private:
  std::vector<Target> targets_;
};

void addRays(const RayBench& rays, TargetList& list) {
  for (const auto& f : rays.figures) {
    const double target = f.what == "scans" ? 1 : 2;
    const std::string what =
        "rays: " + f.what + " to " + fixed(f.range_m, 0) + " m, relative to Embree's " + f.peer_call;
    if (rays.peer.empty()) {
      list.add({what, "≥ " + fixed(target, 2) + " times", "no Embree", std::nullopt});
    } else {
      list.atLeast(target, what, {f.ratio(), 2, "times"});
    }
  }
}

/// No ratio is required for Enki, because it computes contacts, which RoboSim does not.
void addEnki(const EnkiBench& enki, TargetList& list) {
  const std::string what = "infrared: CPU time of a robot-step, Enki's relative to RoboSim's, ";
  if (!enki.why_no_peer.empty()) list.add({what + "one core", "–", "no Enki", std::nullopt});
  for (const auto& f : enki.figures) {
    list.add({what + withCommas(f.robots) + " robots", "–", fixed(f.ratio(), 1) + " times", std::nullopt});
  }
}

void addRobots(const Loads& loads, TargetList& list) {
  list.atLeast(1e6, "sonar: robot-steps per second, 100,000 robots, two threads",
               {1 / loads("sonar", kMany, 2).robot_step.wall_s, 0, "/s"});
}

/// Memory per robot, as the slope between two world sizes, which excludes the program's own memory.
void addLoading(const SpeedFigures& figures, TargetList& list) {
  const double growth_mb = figures.many_loaded.rss_growth_mb - figures.some_loaded.rss_growth_mb;
  list.atMost(2048, "sonar, 100,000 robots: memory per robot", {growth_mb * 1024 * 1024 / (kMany - kSome), 0, "bytes"});
  list.atMost(5, "sonar, 100,000 robots: loading the world's file, CPU time", {figures.many_loaded.load.cpu_s, 2, "s"});
}

void addDigests(const std::vector<RobotFigures>& loads, TargetList& list) {
  bool same = true;
  for (const auto& a : loads) {
    for (const auto& b : loads) {
      if (a.workload == b.workload && a.robots == b.robots) same = same && a.digest == b.digest;
    }
  }
  list.add(
      {"digest with one thread and with two, every workload", "the same", same ? "the same" : "not the same", same});
}

double ratio(double Cost::*time, const std::vector<Cost>& costs) { return costs[1].*time / costs[0].*time; }

}  // namespace

std::vector<RobotLoad> standardLoads() {
  std::vector<RobotLoad> loads;
  for (const auto& workload : workloads()) {
    for (const std::size_t robots : {100, 1000, 10000}) loads.push_back({&workload, robots, 1});
    loads.push_back({&workload, kSome, 2});
  }
  for (const int threads : {1, 2}) loads.push_back({&workloadNamed("sonar"), kMany, threads});
  return loads;
}

std::vector<Target> readTargets(const SpeedFigures& figures) {
  const Loads loads(figures.loads);
  TargetList list;
  addRays(figures.rays, list);
  addRobots(loads, list);
  addEnki(figures.enki, list);
  list.atMost(2.5, "sector relative to sonar, 1,000 robots, CPU time",
              {ratio(&Cost::cpu_s, figures.sonar_sector), 2, "times"});
  list.atMost(1.5, "sonar: a robot-step among 100,000 relative to one among 1,000, CPU time",
              {ratio(&Cost::cpu_s, figures.some_many), 2, "times"});
  list.atLeast(1.7, "sonar: two threads relative to one, 100,000 robots",
               {1 / ratio(&Cost::wall_s, figures.one_two), 2, "times"});
  addLoading(figures, list);
  list.atLeast(3000, "opho2_1, four robots, recorder off, one core",
               {1 / figures.small_run.plain.cpu_s, 0, "× real time"});
  const auto addRecording = [&](const std::string& what, const Cost& recorded, double cpu_percent) {
    const std::vector<Cost> costs{figures.small_run.plain, recorded};
    const std::string cost = "opho2_1: cost of recording " + what;
    list.atMost(40, cost + ", wall time", {100 * (ratio(&Cost::wall_s, costs) - 1), 0, "% more"});
    list.atMost(cpu_percent, cost + ", CPU time", {100 * (ratio(&Cost::cpu_s, costs) - 1), 0, "% more"});
  };
  addRecording("a rawlog", figures.small_run.rawlog, 40);
  addRecording("MCAP", figures.small_run.mcap, 30);
  addDigests(figures.loads, list);
  return list.take();
}

}  // namespace robosim
