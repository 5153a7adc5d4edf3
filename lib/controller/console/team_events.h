#pragma once
#include <map>
#include <string>
#include <vector>

#include "remote/robot_news.h"

namespace robosim {

/// The robot that has won the run; empty for none. Robots that have left keep the winner of their run, and those of the
/// next run have none.
std::string winnerOf(const std::vector<TeamRobot>& robots);

/// Generates messages for the driver from changes in the team's state.
class TeamEvents {
 public:
  enum class Kind { up, down, stopped, too_far, won };
  struct Note {
    Kind kind;
    std::string text;         ///< a sentence, for the driver
    std::string detail = {};  ///< the reason, for the operator; empty for none

    /// Both in one line.
    std::string line() const { return detail.empty() ? text : text.substr(0, text.size() - 1) + ": " + detail; }
  };

  /// Messages since the last call. Robots that leave because their run is over, and return for the next, are no events.
  /// @param robots the primary first
  std::vector<Note> news(const std::vector<TeamRobot>& robots);

 private:
  std::map<std::string, RobotNews> previous_;  ///< by name
};

}  // namespace robosim
