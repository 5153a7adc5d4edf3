#pragma once
#include <string>
#include <vector>

#include "environment/environment.h"
#include "hardware/hardware.h"

namespace robosim {

/// The hardware of a robot that is simulated in this process. The environment must outlive it.
class LocalHardware : public Hardware, public RefereeLink {
 public:
  LocalHardware(Environment& environment, std::size_t robot)
      : environment_(environment),
        state_(environment.state()),
        robot_(robot),
        info_(environment.fleet().robots[robot].info) {}

  /// Its index in the world.
  std::size_t robot() const { return robot_; }

  const RobotInfo& info() const override { return info_; }
  const std::vector<std::string>& robots() const override { return environment_.robotNames(); }
  const Readings& readings() const override { return state_.readings[robot_]; }
  void command(const Command& command) override { environment_.setCommand(robot_, command); }
  const Command& lastCommand() const override { return state_.commands[robot_]; }
  void send(const std::string& to, const std::string& text) override { environment_.send(robot_, to, text); }
  void broadcast(const std::string& text) override { environment_.broadcast(robot_, text); }
  RefereeLink* referee() override { return this; }
  void checkWin() override { environment_.checkWin(robot_); }

 private:
  Environment& environment_;
  // Kept, because controllers ask for them many times in a step.
  const State& state_;
  std::size_t robot_;
  const RobotInfo& info_;
};

}  // namespace robosim
