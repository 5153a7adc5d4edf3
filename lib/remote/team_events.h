#pragma once
#include <map>
#include <string>
#include <vector>

#include "remote/robot_news.h"

namespace robosim {

/// Generates messages for the driver from changes in the team's state.
class TeamEvents {
 public:
  enum class Kind { up, down, stopped, too_far, won };
  struct Note {
    Kind kind;
    std::string text;
  };

  /// Messages since the last call.
  /// @param robots the primary first
  std::vector<Note> news(const std::vector<TeamRobot>& robots);

 private:
  std::map<std::string, RobotNews> previous_;  ///< by name
};

}  // namespace robosim
