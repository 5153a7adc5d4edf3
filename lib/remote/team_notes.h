#pragma once
#include <map>
#include <string>
#include <vector>

#include "remote/remote_control.h"

namespace robosim {

/// What has happened to a team, in sentences for the person who drives.
class TeamNotes {
 public:
  enum class Kind { up, down, stopped, too_far, won };
  struct Note {
    Kind kind;
    std::string text;
  };

  /// What is new since the last call.
  /// @param robots the primary first
  std::vector<Note> news(const std::vector<RemoteControl::Robot>& robots);

 private:
  std::map<std::string, RobotNews> told_;  ///< by name
};

}  // namespace robosim
