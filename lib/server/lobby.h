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
  bool is_over = false;                    ///< everyone was told goodbye: who comes now is sent away
  std::shared_ptr<const Exhibit> exhibit;  ///< never null once the server listens

  /// Whether a client may have this conversation: asked first of all, with the mutex held.
  grpc::Status mayEnter(const grpc::ServerContextBase& client, Right right) const {
    const grpc::Status status = access.check(client, right);
    return status.ok() && is_over ? runIsOver() : status;
  }
  static grpc::Status runIsOver() { return {grpc::StatusCode::UNAVAILABLE, "the run is over"}; }
};

}  // namespace robosim
