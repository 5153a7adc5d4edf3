// Robot processes and geometry workers are killed, frozen, disconnected and impersonated at random: the run continues,
// and no step is lost or taken twice. ROBOSIM_SOAK_SECONDS sets the duration, ROBOSIM_SOAK_SEED the sequence of events.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <map>
#include <random>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/serving.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

constexpr std::size_t kProcesses = 10, kRobotsEach = 5;

int numberFrom(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : otherwise;
}

/// Injects faults into a served run.
class FaultInjector {
 public:
  FaultInjector(Serving& serving, std::uint32_t seed) : serving_(serving), random_(seed) {
    for (std::size_t i = 0; i < kProcesses; ++i) {
      std::vector<std::string> names;
      for (std::size_t k = 0; k < kRobotsEach; ++k) {
        const std::size_t robot = i * kRobotsEach + k;
        names.push_back((robot % 2 == 0 ? "Pioneer" : "Scout") + std::to_string(robot / 2 + 1));
      }
      names_.push_back(names);
      processes_.push_back(startRobots(names, serving.address()));
    }
    worker_ = startWorker(serving.address());
  }

  /// Injects a random fault.
  void inject() {
    const std::size_t i = below(kProcesses);
    switch (below(7)) {
      case 0:
        processes_[i]->signal(SIGKILL);
        processes_[i] = startRobots(names_[i], serving_.address());
        break;
      case 1:
        processes_[i]->signal(SIGSTOP);
        break;
      case 2:
        resumeAll();
        break;
      case 3:
        worker_->signal(SIGKILL);
        worker_ = startWorker(serving_.address());
        break;
      case 4:
        worker_->signal(SIGSTOP);
        break;
      case 5:  // claims robots of another process, which succeeds if that is frozen
        claimant_ = startRobots(names_[i], serving_.address());
        break;
      default: {  // sends random bytes
        StartedProgram noise("/usr/bin/openssl", {"s_client", "-connect", serving_.address()});
        noise.wait();
      }
    }
    // Processes that were disconnected for longer than their --reconnect-timeout have ended, and are replaced.
    for (std::size_t k = 0; k < kProcesses; ++k) {
      if (!processes_[k]->isRunning()) processes_[k] = startRobots(names_[k], serving_.address());
    }
    if (!worker_->isRunning()) worker_ = startWorker(serving_.address());
  }

  void resumeAll() {
    for (const auto& process : processes_) process->signal(SIGCONT);
    worker_->signal(SIGCONT);
  }

  std::size_t below(std::size_t n) { return random_() % n; }

 private:
  Serving& serving_;
  std::mt19937 random_;
  std::vector<std::vector<std::string>> names_;
  std::vector<std::unique_ptr<StartedProgram>> processes_;
  std::unique_ptr<StartedProgram> worker_, claimant_;
};

/// The steps at which each robot's true pose was recorded, in the file's order.
std::map<std::string, std::vector<long>> recordedSteps(const std::filesystem::path& rawlog) {
  std::map<std::string, std::vector<double>> seconds;
  forEachObservation(rawlog, [&](const mrpt::obs::CObservation::Ptr& observation) {
    if (!std::dynamic_pointer_cast<mrpt::obs::CObservationRobotPose>(observation)) return;
    seconds[observation->sensorLabel].push_back(mrpt::Clock::toDouble(observation->timestamp));
  });
  std::map<std::string, std::vector<long>> steps;
  for (const auto& [label, times] : seconds) {
    for (const double time : times) steps[label].push_back(std::lround((time - times.front()) / 0.1));
  }
  return steps;
}

TEST(Soak, NeitherLosesNorRepeatsSteps) {
  const auto folder = emptyFolder();
  const auto world = folder / "open_50.xml";
  ASSERT_EQ(runProgram("generate open '" + world.string() + "' --robots 50 --controller wander").exit_code, 0);
  const auto rawlog = folder / "run.rawlog";
  const int seed = numberFrom("ROBOSIM_SOAK_SEED", 1);
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(numberFrom("ROBOSIM_SOAK_SECONDS", 60));
  Serving serving({"--wait-for-robots", "--paused", "--json", "--time", "1e9", "--step-deadline", "0.5",
                   "--on-lost-robot", "continue", "--record", rawlog.string()},
                  world.string());
  FaultInjector faults(serving, static_cast<std::uint32_t>(seed));
  long steps = 0;
  const auto step = [&] {
    const std::size_t count = 1 + faults.below(20);
    const Ended ended = runProgram("control " + serving.address() + " step " + std::to_string(count));
    ASSERT_EQ(ended.exit_code, 0) << ended.err << serving.program().error();
    steps += static_cast<long>(count);
  };
  int strikes = 0;
  do {
    step();
    faults.inject();
    ++strikes;
  } while (std::chrono::steady_clock::now() < until && serving.program().isRunning());

  faults.resumeAll();
  step();
  serving.program().signal(SIGTERM);
  const Ended ended = serving.program().wait();
  const auto summary = nlohmann::json::parse(ended.out);
  constexpr int kIncomplete = 3;
  ASSERT_EQ(ended.exit_code, summary["clients"]["all_robots"] == true ? 0 : kIncomplete) << ended.err;
  EXPECT_EQ(summary["steps"], steps) << ended.err;
  const auto recorded = recordedSteps(rawlog);
  EXPECT_EQ(recorded.size(), kProcesses * kRobotsEach);
  std::vector<long> every(static_cast<std::size_t>(steps) + 1);
  for (std::size_t i = 0; i < every.size(); ++i) every[i] = static_cast<long>(i);
  for (const auto& [label, of_robot] : recorded) EXPECT_EQ(of_robot, every) << label;
  std::cout << steps << " steps, " << strikes << " strikes from the seed " << seed << "; "
            << countOf("disconnected", ended.err) << " disconnected, " << countOf("has left", ended.err) << " left, "
            << countOf("refused", ended.err) << " refused\n";
}

}  // namespace
}  // namespace robosim
