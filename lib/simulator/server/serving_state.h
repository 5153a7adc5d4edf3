#pragma once
#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>

#include "net/audit.h"
#include "net/session_host.h"
#include "server/run_info.h"

namespace robosim {

/// Synchronisation of the environment's steps with its robots.
enum class Pace {
  lockstep,  ///< each step waits for every robot's command: the run is reproducible
  realtime,  ///< steps are taken at fixed times; a late robot keeps its last command
};

/// State shared by all sessions of one server. Used only by the thread that steps the environment.
struct ServingState : SessionHost {
  /// Maximum duration of one wait. An interrupt does not end a wait, so that longer waits are split.
  static constexpr std::chrono::milliseconds kPollInterval{50};

  std::function<bool()> interrupted = [] { return false; };  ///< whether the server is to end
  Clock::duration step_deadline;
  Clock::duration load_deadline;  ///< maximum time for a control panel to send a world
  Pace pace = Pace::lockstep;
  std::shared_ptr<const RunInfo> run_info;  ///< never null once the server listens
  bool wake_requested = false;              ///< a request is pending that is executed between steps; ends the wait

  /// Processes client events until `is_done` returns true, for at most `timeout` and kPollInterval.
  void pollUntil(Clock::duration timeout, const std::function<bool()>& is_done) const {
    const auto wait = std::clamp<Clock::duration>(timeout, Clock::duration::zero(), kPollInterval);
    queue_server->waitUntil(CompletionQueueServer::Clock::now() + wait, is_done);
  }
};

}  // namespace robosim
