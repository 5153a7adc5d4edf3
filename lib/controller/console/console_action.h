#pragma once
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "console/web_message.h"
#include "net/access.h"
#include "remote/orders.h"

namespace robosim {

/// @file
/// Outputs of ConsoleSession, to be performed in sequence.

/// A message may be available for a page: ConsoleSession::nextMessage().
struct WakePage {
  PageId page;
};
/// Disconnects a page after its queued messages have been sent.
struct DisconnectPage {
  PageId page;
  std::string why;
};

/// Sends an order to the primary robot.
struct SendOrder {
  v1::ControlRequest order;
};
/// Claims the primary robot for a driver. The robot stands until it is steered.
struct SetDriver {
  std::string name;
};
/// Makes another robot the primary; the result is reported by the next ConsoleSession::update().
struct SwitchPrimary {
  std::string robot;
};

/// Starts the environment's world again, after its run has ended.
struct RestartRun {};
/// Starts or stops the recording of the environment's run.
struct RecordRun {
  bool on;
};

/// Starts or stops the map, which is fetched only while a page shows it.
struct WatchMap {
  bool watched;
};

/// Writes a line to the log. Lines with a kind can be caused by any client, and are rate-limited per kind.
struct WriteLog {
  std::string_view kind;  ///< empty: not limited. A constant
  std::string line;
};
/// Writes a line to the audit log (AuditLog).
struct WriteAudit {
  Identity client;
  std::string peer, action;
};

using ConsoleAction = std::variant<WakePage, DisconnectPage, SendOrder, SetDriver, SwitchPrimary, RestartRun, RecordRun,
                                   WatchMap, WriteLog, WriteAudit>;
using ConsoleActions = std::vector<ConsoleAction>;

}  // namespace robosim
