#pragma once
#include <string>
#include <utility>
#include <vector>

#include "hardware/hardware.h"

namespace robosim {

/// A robot of a recording: it senses what it sensed then, and whatever its controller commands changes nothing.
class ReplayedHardware : public Hardware {
 public:
  explicit ReplayedHardware(RobotInfo info) : info_(std::move(info)) {}

  const RobotInfo& info() const override { return info_; }
  const Readings& readings() const override { return readings_; }
  void command(const Command& command) override { command_ = command; }
  void send(const std::string& to, const std::string& text) override { sent_.push_back({info_.name, to, text}); }
  void checkWin() override {}  // the recording has the answer

  /// Goes on to the next step.
  void replay(Readings readings) {
    readings_ = std::move(readings);
    sent_.clear();
  }
  /// What the robot would do in the next step.
  const Command& lastCommand() const { return command_; }
  /// Messages sent since the last step was replayed.
  const std::vector<RobotMessage>& sent() const { return sent_; }

 private:
  RobotInfo info_;
  Readings readings_;
  Command command_;
  std::vector<RobotMessage> sent_;
};

}  // namespace robosim
