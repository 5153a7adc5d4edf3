#include "tests/instructions/loads.h"

#include <memory>
#include <string>
#include <vector>

#include "learning/environment_batch.h"
#include "robosim_bench/ray_caster.h"
#include "robosim_bench/workloads.h"
#include "run/local_run.h"

namespace robosim {
namespace {

constexpr std::uint64_t kSeed = 1;

/// 100 robots after some warm-up steps.
InstructionWork robots(const Workload& workload) {
  constexpr std::size_t kRobots = 100;
  constexpr int kWarmUpSteps = 10;
  constexpr int kSteps = 50;
  const auto run = std::make_shared<LocalRun>(makeWorldToRun(workload, kRobots, kSeed), RunOptions{});
  for (int i = 0; i < kWarmUpSteps; ++i) run->step();
  return {.units = static_cast<double>(kRobots) * kSteps, .work = [run] {
            for (int i = 0; i < kSteps; ++i) run->step();
          }};
}

InstructionWork robots(const char* workload) { return robots(workloadNamed(workload)); }

/// A workload with attributes and content added to each sensor of one kind, of which all ends are "/>".
std::string withErrors(std::string sensors, const std::string& kind, const std::string& attributes,
                       const std::string& content) {
  const auto begin = sensors.find('<' + kind + ' ');
  const auto end = sensors.find('>', begin);
  if (sensors[end - 1] == '/') return sensors.replace(end - 1, 2, ' ' + attributes + '>' + content + "</" + kind + '>');
  return sensors.replace(end, 1, ' ' + attributes + '>' + content);
}

InstructionWork robots(Workload workload, const std::string& sensors) {
  workload.sensors = sensors.c_str();
  return robots(workload);
}

/// The workload `laser` with errors of its scanner: its attributes, and its content.
InstructionWork laserWith(const std::string& attributes, const std::string& content) {
  const Workload workload = workloadNamed("laser");
  return robots(workload, withErrors(workload.sensors, "laser", attributes, content));
}

/// The workload `sonar` with errors of its sonars.
InstructionWork sonarWith(const std::string& attributes, const std::string& content) {
  const Workload workload = workloadNamed("sonar");
  return robots(workload, withErrors(workload.sensors, "sonar", attributes, content));
}

/// The workload `laser` with the errors that `--noise all` adds to its scanner and sonars.
InstructionWork allErrors() {
  const Workload workload = workloadNamed("laser");
  const std::string sonars =
      withErrors(workload.sensors, "sonar", "noise='polaroid' beam_width_deg='84' firing_interval_s='0.04'", "");
  return robots(workload, withErrors(sonars, "laser", "noise='lms200'", "<noise drift_m='0.01'/>"));
}

/// 50 worlds of one robot each, after some warm-up steps.
InstructionWork batch(const std::vector<std::string>& observations) {
  constexpr std::size_t kWorlds = 50;
  constexpr int kSteps = 50;
  struct Batch {
    EnvironmentBatch environments;
    std::vector<float> actions, observations;
    std::vector<double> rewards;
    std::vector<std::uint8_t> terminated, truncated;

    Batch(std::vector<LoadedWorld> worlds, const BatchOptions& options)
        : environments(std::move(worlds), options),
          actions(2 * kWorlds, 0.3f),
          observations(kWorlds * environments.observationSize()),
          rewards(kWorlds),
          terminated(kWorlds),
          truncated(kWorlds) {
      environments.reset(observations);
    }
    void step() { environments.step(actions, {observations, rewards, terminated, truncated}); }
  };
  std::vector<LoadedWorld> worlds;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) worlds.push_back(makeWorldToRun(workloadNamed("laser"), 1, seed));
  BatchOptions options;
  options.environments = kWorlds;
  options.observations = observations;
  const auto made = std::make_shared<Batch>(std::move(worlds), options);
  for (int i = 0; i < 10; ++i) made->step();
  return {.units = static_cast<double>(kWorlds) * kSteps, .work = [made] {
            for (int i = 0; i < kSteps; ++i) made->step();
          }};
}

InstructionWork rays(void (RayCaster::*cast)(double range_m), double range_m) {
  const RayScene scene = makeRayScene(20, kSeed);
  const std::shared_ptr<RayCaster> caster = makeSceneCaster(scene);
  (*caster.*cast)(range_m);  // warm-up, which allocates arrays
  return {.units = static_cast<double>(scene.beams.size()),
          .work = [caster, cast, range_m] { (*caster.*cast)(range_m); }};
}

/// Four gold finders, until all have halted.
InstructionWork smallRun() {
  const auto made = [] {
    return std::make_shared<LocalRun>(loadWorldToRun(ROBOSIM_SOURCE_DIR "/worlds/opho2_1.xml", ""), RunOptions{});
  };
  const auto drive = [](LocalRun& run) {
    while (!run.gold().all_halted_s) run.step();
  };
  const auto rehearsal = made();
  drive(*rehearsal);
  const Environment& environment = rehearsal->environment();
  const double robot_steps =
      static_cast<double>(environment.time().step) * static_cast<double>(environment.robotCount());
  return {.units = robot_steps, .work = [run = made(), drive] { drive(*run); }};
}

/// Loading a world from its file up to the first step.
InstructionWork loading() {
  return {.units = 1, .work = [] {
            const LocalRun run(loadWorldToRun(ROBOSIM_SOURCE_DIR "/worlds/maze_20x20.xml", ""), RunOptions{});
          }};
}

constexpr InstructionLoad kLoads[] = {
    {"sonar", "robot-step", [] { return robots("sonar"); }},
    {"sector", "robot-step", [] { return robots("sector"); }},
    {"laser", "robot-step", [] { return robots("laser"); }},
    {"laser, Gaussian noise", "robot-step", [] { return laserWith("", "<noise/>"); }, false},
    {"laser, Gaussian noise by range and quantum", "robot-step",
     [] { return laserWith("", "<noise quantum_m='0.01'><at range_m='0' std_m='0.005'/></noise>"); }, false},
    {"laser, tail, outliers, drift", "robot-step",
     [] { return laserWith("", "<noise tail='0.1' outlier='0.001' dropout='0.001' drift_m='0.01'/>"); }, false},
    {"laser, mixed pixels", "robot-step", [] { return laserWith("", "<noise divergence_deg='0.25'/>"); }, false},
    {"laser, reflectivity", "robot-step", [] { return laserWith("", "<noise reach_m='20'/>"); }, false},
    {"laser, sweep", "robot-step", [] { return laserWith("sweep_s='0.00667' latency_s='0.01'", ""); }, false},
    {"laser, all errors", "robot-step", [] { return laserWith("noise='lms200' latency_s='0.01'", ""); }},
    {"laser, all errors of laser and sonars", "robot-step", allErrors, false},
    {"sonar, Gaussian noise", "robot-step", [] { return sonarWith("", "<noise/>"); }, false},
    {"sonar, all errors", "robot-step", [] { return sonarWith("noise='polaroid'", ""); }},
    {"infrared", "robot-step", [] { return robots("infrared"); }},
    {"batch of laser", "agent-step",
     [] {
       return batch({"laser", "odometry"});
     }},
    {"batch of odometry", "agent-step", [] { return batch({"odometry"}); }},
    {"rays, scans to 8 m", "ray", [] { return rays(&RayCaster::castScans, 8); }},
    {"rays, scans to 20 m", "ray", [] { return rays(&RayCaster::castScans, 20); }, false},
    {"rays, single rays to 8 m", "ray", [] { return rays(&RayCaster::castSingles, 8); }},
    {"rays, single rays to 20 m", "ray", [] { return rays(&RayCaster::castSingles, 20); }, false},
    {"opho2_1", "robot-step", smallRun},
    {"loading maze_20x20", "world", loading},
};

}  // namespace

std::vector<InstructionLoad> instructionLoads(Form form) {
  std::vector<InstructionLoad> loads;
  for (const auto& load : kLoads) {
    if (form == Form::whole || load.is_in_short_form) loads.push_back(load);
  }
  return loads;
}

}  // namespace robosim

__attribute__((noinline)) void robosimCounted(const std::function<void()>& work) {
  work();
  asm volatile("");  // prevents a tail call, which would leave this function early
}
