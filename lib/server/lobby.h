#pragma once
#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "net/access.h"
#include "net/switchboard.h"
#include "server/exhibit.h"

namespace robosim {

/// How fast an environment steps for its robots.
enum class Pace {
  lockstep,  ///< a step waits for every robot's command: the same run, always
  realtime,  ///< a step comes when its time has come; a late robot keeps its last command
};

/// What all conversations of one server share. All of it happens on the thread that steps the environment.
struct Lobby {
  using Clock = std::chrono::steady_clock;

  /// An interrupt wakes nobody, so all waiting is cut into naps.
  static constexpr std::chrono::milliseconds kNap{50};

  std::function<void(const std::string&)> log;               ///< takes one line
  std::function<bool()> interrupted = [] { return false; };  ///< whether whoever started the server wants it to end
  Clock::duration step_deadline;
  Clock::duration hello_deadline;
  std::function<Clock::time_point()> now;
  Pace pace = Pace::lockstep;
  Access access;
  bool is_over = false;                    ///< everyone was told goodbye: who comes now is sent away
  std::shared_ptr<const Exhibit> exhibit;  ///< never null once the server listens
  Switchboard* switchboard = nullptr;      ///< as well
  bool rang = false;  ///< a client wants something that is done between two steps: do not wait any longer

  /// Whether a client may have this conversation: asked first of all.
  grpc::Status mayEnter(const grpc::ServerContextBase& client, Right right) const {
    const grpc::Status status = access.check(client, right);
    return status.ok() && is_over ? runIsOver() : status;
  }
  static grpc::Status runIsOver() { return {grpc::StatusCode::UNAVAILABLE, "the run is over"}; }

  /// Tells of somebody who was sent away. A stranger may come again and again, so there are few such lines a second.
  void logRefusal(const std::string& line) {
    constexpr int kMost = 10;
    const auto second = std::chrono::floor<std::chrono::seconds>(now());
    if (std::exchange(refusals_in_, second) != second) {
      if (refusals_ > kMost) log(std::to_string(refusals_ - kMost) + " more were refused within a second");
      refusals_ = 0;
    }
    if (++refusals_ <= kMost) log(line);
  }

  /// Lets clients speak until `is_enough`, but no longer than a nap.
  void nap(Clock::duration at_most, const std::function<bool()>& is_enough) const {
    const auto nap = std::clamp<Clock::duration>(at_most, Clock::duration::zero(), kNap);
    switchboard->waitUntil(Switchboard::Clock::now() + nap, is_enough);
  }

 private:
  std::chrono::time_point<Clock, std::chrono::seconds> refusals_in_;
  int refusals_ = 0;  ///< in that second
};

}  // namespace robosim
