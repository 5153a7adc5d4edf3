#include "net/roles.h"

#include <algorithm>
#include <array>

#include "base/error_list.h"

namespace robosim {
namespace {

struct RoleName {
  const char* name;
  Role role;
};
constexpr std::array kRoleNames{RoleName{"viewer", Role::viewer}, RoleName{"robot", Role::robot},
                                RoleName{"geometry", Role::geometry}, RoleName{"operator", Role::operate},
                                RoleName{"supervisor", Role::supervisor}};

}  // namespace

bool permits(Role role, Right right) {
  switch (role) {
    case Role::viewer:
      return right == Right::look;
    case Role::robot:
      return right == Right::drive;
    case Role::geometry:
      return right == Right::work;
    case Role::operate:
      return right != Right::work && right != Right::supervise;
    case Role::supervisor:
      return right == Right::supervise || right == Right::look;
  }
  return false;
}

std::optional<Role> findRole(std::string_view name) {
  const auto* found = std::find_if(kRoleNames.begin(), kRoleNames.end(), [&](auto& role) { return role.name == name; });
  return found == kRoleNames.end() ? std::nullopt : std::optional(found->role);
}

std::string refusalText(Role role, const std::vector<std::string>& robots, Right refused) {
  switch (role) {
    case Role::viewer:
      return "has the role viewer, which permits only to watch; use another";
    case Role::robot:
      return "has the role robot, which permits only to drive " + listed(robots) + "; use another";
    case Role::geometry:
      return "has the role geometry, which permits only 'robosim geometry'; use another";
    case Role::supervisor:
      return "has the role supervisor, which permits only to watch and to change the run; use another";
    case Role::operate:
      break;
  }
  return refused == Right::work
             ? "has the role operator, which does not permit geometry workers; use one of the role geometry"
             : "has the role operator, which does not permit to change the run; use one of the role supervisor";
}

}  // namespace robosim
