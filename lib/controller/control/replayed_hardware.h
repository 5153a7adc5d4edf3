#pragma once
#include <string>
#include <utility>
#include <vector>

#include "hardware/hardware.h"

namespace robosim {

/// A robot of a recording: returns the recorded readings. Commands have no effect on them.
class ReplayedHardware : public Hardware, public RefereeLink {
 public:
  /// @param robots names of all robots of the recorded run, in the world's order; must outlive this
  ReplayedHardware(RobotInfo info, const std::vector<std::string>& robots) : info_(std::move(info)), robots_(robots) {}

  const RobotInfo& info() const override { return info_; }
  const std::vector<std::string>& robots() const override { return robots_; }
  const Readings& readings() const override { return readings_; }
  void command(const Command& command) override { command_ = command; }
  const Command& lastCommand() const override { return command_; }
  void send(const std::string& to, const std::string& text) override { sent_.push_back({info_.name, to, text}); }
  RefereeLink* referee() override { return this; }
  void checkWin() override {}  // the recording contains the result

  /// Advances to the next step.
  void replay(Readings readings) {
    readings_ = std::move(readings);
    sent_.clear();
  }
  /// Messages sent since the last step was replayed.
  const std::vector<RobotMessage>& sent() const { return sent_; }

 private:
  RobotInfo info_;
  const std::vector<std::string>& robots_;
  Readings readings_;
  Command command_;
  std::vector<RobotMessage> sent_;
};

}  // namespace robosim
