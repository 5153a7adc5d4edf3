#pragma once
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "environment/environment.h"
#include "live_page/live_encoding.h"
#include "live_page/live_page_server.h"
#include "server/run_control.h"
#include "serving/ros2_changes.h"

namespace robosim {

struct PageOptions {
  LivePageServer::Options server;
  bool is_realtime = false;  ///< the run keeps real time: its speed has a limit
};

/// Shows the runs of a program on a page in browsers (LivePageServer), and executes what its users request: pause,
/// steps, speed, and places of robots and objects. All functions are called by the thread that steps the environment;
/// none of them waits. The run is only read: its digest is the same with any number of pages.
class PageServing {
 public:
  /// Between two moments that pages receive, whatever the speed of the run.
  static constexpr std::chrono::milliseconds kMomentPeriod{40};

  /// Opens the port. @throws std::runtime_error as LivePageServer
  explicit PageServing(const PageOptions& options) : options_(options), server_(options.server) {}
  /// Pages receive the last moment, and that the run is over.
  ~PageServing();

  int port() const { return server_.port(); }
  /// Serves a run instead of the one before. @param environment must outlive its time here @param id another one for
  /// each run
  void begin(const Environment& environment, const std::string& id, std::uint64_t seed);
  /// Serves the robots that have been added to the run, too.
  void addRobots();
  /// Handles requests. Between steps, at least every ServingState::kPollInterval.
  void poll(RunControl& control, bool is_over, const Intervene& intervene);
  /// Notes a step, and sends it if kMomentPeriod has passed.
  void stepped();

 private:
  using Clock = std::chrono::steady_clock;

  void noteEvents();
  void send();
  std::string execute(const LiveRequest& request, RunControl& control, const Intervene& intervene) const;

  PageOptions options_;
  LivePageServer server_;
  const Environment* environment_ = nullptr;
  std::optional<LiveEncoding> encoding_;
  LiveControl control_;
  std::vector<LiveEvent> events_;  ///< since the last moment that was sent
  std::uint64_t pose_changes_ = 0;
  bool is_due_ = false;  ///< the present state has not been sent
  Clock::time_point sent_;
};

}  // namespace robosim
