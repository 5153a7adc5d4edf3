#pragma once
#include <string>

#include "console/page_message.h"
#include "net/access.h"

namespace robosim {

/// State of a page and of the console on which authorisation depends.
struct PageState {
  bool is_admitted = false;  ///< its hello was accepted
  bool holds_lock = false;
  std::string primary;            ///< name of the primary robot
  bool is_primary_known = false;  ///< it has been connected
  bool is_switching = false;      ///< a switch to another robot is pending
};

struct Authorization {
  enum class Result {
    permitted,
    ignored,         ///< no effect: sent before the page received that its state has changed
    denied,          ///< the token does not permit it; the page is informed
    protocol_error,  ///< the page is disconnected
  };
  Result result = Result::permitted;
  std::string why;  ///< if denied or an error: text for the user
};

/// Authorises a message against the current tokens. A `hello` is permitted: its handler checks the token.
Authorization authorize(const Access& access, const Identity& client, const PageState& state,
                        const PageMessage& message);

/// @name Rights of a page's token now
///@{
bool mayLook(const Access& access, const Identity& client);
bool mayDrive(const Access& access, const Identity& client, const std::string& robot);
bool mayOperate(const Access& access, const Identity& client);
/// Whether a page with this token is admitted at all.
bool mayJoin(const Access& access, const Identity& client);
///@}

}  // namespace robosim
