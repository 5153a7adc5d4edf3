#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace robosim {

/// Right to a class of actions.
enum class Right {
  look,       ///< watch the run, and query its status
  drive,      ///< drive robots
  work,       ///< compute part of each step: the results become part of the run
  operate,    ///< start, pause, speed, load, stop
  supervise,  ///< change the run from outside: place, add, remove (world/intervention.h)
};

/// Role of a token.
enum class Role { viewer, robot, geometry, operate, supervisor };

/// Whether tokens of a role have a right. Tokens of the role robot may drive only the robots named in their line. The
/// role operate has every right except `work` and `supervise`: only geometry workers contribute results to a run, and
/// only supervisors change what has happened in it. These may also watch.
bool permits(Role role, Right right);

/// The role with this name in a token file; nullopt for another word.
std::optional<Role> findRole(std::string_view name);

/// What the holder of a token has instead of a right, and what to do, for the text of a refusal: "has the role …; use
/// another". @param robots that a token of the role robot may drive
std::string refusalText(Role role, const std::vector<std::string>& robots, Right refused);

}  // namespace robosim
