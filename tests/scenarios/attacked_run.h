#pragma once
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "client/control_panel.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/serving.h"
#include "tests/scenarios/verifying.h"

namespace robosim {

/// Resident memory of a process [MiB].
inline double residentMib(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string word; status >> word;) {
    double kib = 0;
    if (word == "VmRSS:" && status >> kib) return kib / 1024;
  }
  return 0;
}

/// `robosim serve` in lockstep with the small maze, whose two robots another process drives; the target of attacks.
class AttackedRun {
 public:
  /// @param arguments of `robosim serve`
  explicit AttackedRun(std::vector<std::string> arguments = {}) : serving_(withRobotsElsewhere(std::move(arguments))) {
    ConnectOptions options;
    options.address = address();
    panel_ = std::make_unique<ControlPanel>(options);
  }

  /// Starts the robots, and waits until they are connected.
  /// @param at address of the server, with connection options
  void connectRobots(std::vector<std::string> at) {
    at.insert(at.begin(), {"robot", "Pioneer1", "Scout1", "--controller", "wander", "--environment"});
    robots_ = std::make_unique<StartedProgram>(at);
    server().waitForError("all robots are connected");
  }
  void connectRobots() { connectRobots({address()}); }

  const std::string& address() const { return serving_.address(); }
  StartedProgram& server() { return serving_.program(); }
  double residentMib() { return robosim::residentMib(server().process()); }
  /// Control panel client whose connection is opened before the attack.
  v1::RunStatus status() { return panel_->status(); }
  std::uint64_t step() { return status().step(); }
  /// Takes a number of steps.
  /// @throws std::runtime_error with the logs of both programs when the run makes no progress for kMaxPolls polls
  void waitForSteps(std::uint64_t steps) {
    constexpr int kMaxPolls = 300'000;  // at least one minute
    auto seen = step();
    const auto until = seen + steps;
    for (int polls = 0; seen < until; ++polls) {
      if (polls == kMaxPolls) {
        throw std::runtime_error("the run stands still at step " + std::to_string(seen) + " of " +
                                 std::to_string(until) + "\nserver:\n" + server().error() + "\nrobots:\n" +
                                 (robots_ ? robots_->error() : "not started"));
      }
      const auto now = step();
      if (now != std::exchange(seen, now)) polls = 0;
    }
  }
  /// Steps per second during a call of a function.
  double paceDuring(const std::function<void()>& act) {
    const auto begin = std::chrono::steady_clock::now();
    const auto first = step();
    act();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    return static_cast<double>(step() - first) / took.count();
  }
  /// Whether both robots are connected and no robot connection was ever closed.
  bool hasKeptAllRobots() {
    const std::string log = server().error();
    return status().robots_connected() == 2 && countOf("robots Pioneer1, Scout1", log) == 1;
  }

 private:
  static std::vector<std::string> withRobotsElsewhere(std::vector<std::string> arguments) {
    for (const char* word : {"--wait-for-robots", "--time", "1000000"}) arguments.emplace_back(word);
    return arguments;
  }
  Serving serving_;
  std::unique_ptr<ControlPanel> panel_;
  std::unique_ptr<StartedProgram> robots_;
};

}  // namespace robosim
