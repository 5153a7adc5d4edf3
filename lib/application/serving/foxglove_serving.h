#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "foxglove/server.h"
#include "run/local_run.h"
#include "server/run_control.h"
#include "serving/foxglove_commands.h"
#include "serving/topic_feed.h"

namespace robosim {

struct FoxgloveOptions {
  foxglove::Server::Options server;
  bool is_realtime = false;  ///< the run keeps real time: its speed has a limit
};

/// What is served.
struct FoxgloveRun {
  std::shared_ptr<const Model> model;
  const State& state;  ///< must outlive its time here
  std::string id;      ///< another one for each run
  std::optional<std::uint64_t> seed = {};
  FeedOptions topics = {};
  std::optional<double> duration_s = {};  ///< of a recording that is played; clients go to any time of it
  std::string why_not_operated = {};      ///< why no client can pause it; empty if one with the right can
};

/// Recording of a run, as its clients see and change it.
struct FoxgloveRecording {
  bool is_possible = false, is_on = false;
  /// Starts or stops it. @throws ConfigError when that is not possible
  std::function<void(bool)> set = [](bool) {};
};

/// Address of --foxglove, "host:port"; a host without a port gets 8765. @throws ConfigError
std::string foxgloveAddress(const std::string& address);
/// Line of the log that names the address, with the port that was chosen.
std::string foxgloveLine(const foxglove::Server::Options& options, int port);

/// Serves the runs of a program to Foxglove and other clients of its protocol: topics (TopicFeed), driving
/// (RobotDrivers), parameters and services. All functions are called by the thread that steps the environment; none
/// of them waits.
class FoxgloveServing {
 public:
  /// Opens the port. @param drivers of the runs; must outlive this @throws std::runtime_error as foxglove::Server
  FoxgloveServing(const FoxgloveOptions& options, RobotDrivers& drivers);
  ~FoxgloveServing();

  int port() const { return server_.port(); }
  /// Serves a run instead of the one before, or the robots that have been added to it, too: clients receive the list of
  /// topics again.
  void begin(const FoxgloveRun& run);
  /// Handles requests, and sends the state to new clients. Between steps, at least every ServingState::kPollInterval.
  void poll(RunControl& control, const FoxgloveRecording& recording);
  /// The time of a recording to which a client wants to go; nullopt: none. The next step is sent as the first is.
  std::optional<double> takeSeek();
  /// Sends the messages of a step.
  void stepped() { feed_->stepped(); }
  /// As TopicFeed
  std::vector<std::uint8_t> pictured() const { return feed_->pictured(); }

 private:
  class Outlet;
  std::vector<foxglove::Parameter> parameters(const RunControl& control, const FoxgloveRecording& recording) const;
  void change(const foxglove::ParameterChange& change, RunControl& control, const FoxgloveRecording& recording);
  std::string setParameter(const foxglove::Client& client, const foxglove::Parameter& parameter, RunControl& control,
                           const FoxgloveRecording& recording);
  void call(const foxglove::ServiceRequest& request, RunControl& control);
  void play(const foxglove::PlaybackRequest& request, RunControl& control);
  std::string whyNotOperated(const foxglove::Client& client);
  foxglove::PlaybackState playback(const RunControl& control) const;

  FoxgloveOptions options_;
  RobotDrivers& drivers_;
  FoxgloveCommands commands_;
  foxglove::Server server_;
  std::unique_ptr<Outlet> outlet_;
  std::optional<TopicFeed> feed_;
  std::optional<FoxgloveRun> run_;
  std::optional<double> seek_s_;
  std::optional<foxglove::PlaybackState> playback_;       ///< as the clients know it
  std::chrono::steady_clock::time_point parameters_due_;  ///< when clients are informed of changes
};

}  // namespace robosim
