#pragma once
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "net/connect.h"
#include "run/local_run.h"
#include "server/environment_server.h"

namespace robosim {

/// A world served by this process, on a port chosen by the system.
class ServedWorld final : private ServedRun {
 public:
  struct Options {
    std::string world = "worlds/small_maze.xml";
    std::string controller = "wander";
    bool robots_elsewhere = false;  ///< driven by other processes; otherwise by `controller`
    std::uint64_t last_step = UINT64_MAX;
    std::function<void()> before_preparing = [] {};  ///< called on the thread that builds a loaded world
    /// `listen` and `log` are overwritten. No client is disconnected because a slow machine delays it.
    ServerOptions server = withStepDeadline(std::chrono::minutes(10));
  };
  static ServerOptions withStepDeadline(std::chrono::milliseconds deadline) {
    ServerOptions options;
    options.step_deadline = deadline;
    return options;
  }
  explicit ServedWorld(const Options& options);
  ~ServedWorld() override;  ///< ends the run

  ConnectOptions connectOptions() const;
  const std::vector<std::string>& robotNames() const { return run_->run_info.robot_names; }
  int port() const { return server_->ports().front(); }

  /// Whether a step is in progress.
  /// Waits until a step has begun and not ended.
  void waitUntilStepping();

  /// Ends the run unless it has ended, and waits for its end.
  Served end();
  /// Waits until the run ends by itself, or is stopped by a control panel.
  Served wait();
  /// To be called after the end, or while the run is paused.
  std::string digest() const { return run_->run.environment().digest(); }
  const State& state() const { return run_->run.environment().state(); }
  /// To be called after the end.
  const RunReport& report() const { return report_; }

  std::string log() const;
  /// Waits until the log contains `text` a number of times.
  void waitForLog(const std::string& text, std::size_t times = 1);

 private:
  struct LoadedRun {
    std::vector<std::uint8_t> networked;
    LocalRun run;
    RunInfo run_info;
    LoadedRun(LoadedWorld world, const WorldSource& source, const Options& options);
    /// Their controllers are of this process.
    void addRobots() {
      run.followAdditions();
      run_info.addRobots(std::vector<std::uint8_t>(run.environment().robotCount() - run_info.robot_names.size()));
    }
  };
  struct PreparedWorld final : PreparedRun {
    std::shared_ptr<LoadedRun> loaded;
  };
  std::shared_ptr<LoadedRun> loadedRunOf(const WorldSource& source) const;
  Environment& environment() override { return run_->run.environment(); }
  std::shared_ptr<const RunInfo> runInfo() const override { return {run_, &run_->run_info}; }
  void addRobots() override { run_->addRobots(); }
  void decide() override {
    run_->run.decide();
    setStepping(true);
  }
  void stepped(std::size_t) override { setStepping(false); }
  void setStepping(bool is_stepping);
  bool isOver() const override { return run_->run.environment().time().step >= options_.last_step; }
  void ends(const RunReport& report) override { report_ = report; }
  std::unique_ptr<PreparedRun> prepare(const WorldSource& source) const override;
  void replace(std::unique_ptr<PreparedRun> next) override;

  Options options_;
  mutable std::mutex mutex_;
  std::condition_variable condition_;
  std::string log_;
  bool must_end_ = false;
  bool is_stepping_ = false;
  std::shared_ptr<LoadedRun> run_;
  RunReport report_;
  std::unique_ptr<EnvironmentServer> server_;
  Served how_ = Served::to_its_end;
  std::thread thread_;
};

inline ServedWorld::Options paused() {
  ServedWorld::Options options;
  options.server.is_paused = true;
  return options;
}

}  // namespace robosim
