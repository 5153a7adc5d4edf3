#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "run/outputs/run_outputs.h"
#include "run/run_summary.h"
#include "server/served_run.h"
#include "serving/arcos_server.h"
#include "serving/live_serving.h"

namespace robosim {

struct WorldRunOptions {
  RunArguments of_run;
  bool wait_for_robots = false;       ///< for a process for every robot, including those with a controller
  bool is_realtime = false;           ///< late commands are counted, rather than awaited
  std::optional<ArcosOptions> arcos;  ///< serve robots of isForArcos() to ARCOS programs
  LiveOptions live;
};

/// The runs of one served program: loading another world from a control panel starts the next run. Each has its own
/// outputs; the names of those after the first are numbered: run_2.rawlog.
class WorldRun final : public ServedRun {
 public:
  /// Loads the first world, and opens its outputs and the ports for ARCOS programs.
  /// @throws ConfigError @throws RecordingError @throws std::runtime_error for a port in use
  explicit WorldRun(WorldRunOptions options);
  ~WorldRun() override;

  Environment& environment() override;
  std::shared_ptr<const RunInfo> runInfo() const override;  ///< keeps its run alive
  void addRobots() override;
  void poll(RunControl& control) override;
  std::unique_ptr<PreparedRun> takeRequestedRun() override;
  void requestPictures(const std::vector<std::uint8_t>& robots) override;
  void decide() override;
  void stepped(std::size_t late) override;
  bool isOver() const override;
  RecordingStatus recording() const override;
  void setRecording(bool on) override;
  void ends(const RunReport& report) override;
  std::unique_ptr<PreparedRun> prepare(const WorldSource& source) const override;
  void makeReady(PreparedRun& next) const override;
  void replace(std::unique_ptr<PreparedRun> next) override;

  /// Why a run ended that neither a person nor a lost robot has ended: all robots halted, or the time limit.
  EndedBy endedByItself() const;
  /// Writes the outputs of the current run, and prints its summary; once for each run.
  void finish(EndedBy ended_by);
  /// Closes the recording of a failed run, keeping what was recorded.
  void keep();

  /// @name Of all runs so far
  ///@{
  bool hadAllRobots() const { return had_all_robots_; }  ///< no step without a robot, no message lost
  bool isTrusted() const {
    return is_trusted_;
  }  ///< no geometry worker returned wrong results
     ///@}

 private:
  class OneRun;
  class Prepared;
  std::shared_ptr<OneRun> load(WorldSource source, int number) const;
  std::unique_ptr<Prepared> prepareFrom(const std::function<WorldSource()>& read) const;
  std::unique_ptr<ArcosServer> makeArcosServer(OneRun& run) const;
  /// Begins to load the map that an ARCOS program has asked for.
  void loadRequestedMap();
  void logArcosPorts() const;
  /// By robot, why clients of LiveServing cannot drive it; empty if they can.
  std::vector<std::string> whyNotDriven() const;
  /// Begins to serve the current run by LiveServing, if it is used.
  void beginLive();

  WorldRunOptions options_;
  std::shared_ptr<OneRun> run_;         ///< shared with viewers
  std::unique_ptr<ArcosServer> arcos_;  ///< of the current run; null without ARCOS
  std::unique_ptr<LiveServing> live_;   ///< null without Foxglove, ROS 2 and pages; destroyed before the run
  std::vector<std::uint8_t> pictured_;  ///< by robot: whether clients of the environment's server receive its pictures
  int number_ = 1;
  /// Whether a next run is being prepared or is prepared: each opens the same outputs.
  std::shared_ptr<std::atomic<bool>> has_next_ = std::make_shared<std::atomic<bool>>(false);
  std::future<std::unique_ptr<PreparedRun>> of_program_;  ///< run with the map that an ARCOS program has asked for
  bool had_all_robots_ = true;
  bool is_trusted_ = true;
};

}  // namespace robosim
