#pragma once
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "net/access.h"
#include "server/exhibit.h"

namespace robosim {

/// How fast an environment steps for its robots.
enum class Pace {
  lockstep,  ///< a step waits for every robot's command: the same run, always
  realtime,  ///< a step comes when its time has come; a late robot keeps its last command
};

/// What all conversations of one server share. gRPC's threads and the one that steps the environment meet here: what
/// they both touch is touched with the mutex held, and whoever changes it rings the bell.
struct Lobby {
  using Clock = std::chrono::steady_clock;

  std::mutex mutex;
  std::condition_variable bell;
  std::function<void(const std::string&)> log;  ///< takes one line; called with the mutex held
  Clock::duration step_deadline = std::chrono::seconds(1);
  Pace pace = Pace::lockstep;
  Access access;                           ///< constant once the server listens
  std::shared_ptr<const Exhibit> exhibit;  ///< never null once the server listens
};

}  // namespace robosim
