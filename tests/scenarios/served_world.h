#pragma once
#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "net/dial.h"
#include "robosim/local_run.h"
#include "server/environment_server.h"

namespace robosim {

/// A world that is served by this process while the test looks on, on a port that the system chose.
class ServedWorld final : private ServedRun {
 public:
  struct Options {
    std::string world = "worlds/small_maze.xml";
    std::string controller = "wander";
    bool robots_elsewhere = false;  ///< in processes of their own; otherwise `controller` drives them here
    std::uint64_t last_step = UINT64_MAX;
    ServerOptions server;  ///< `listen` and `log` are the test's own
  };
  explicit ServedWorld(const Options& options);
  ~ServedWorld() override;  ///< ends the run

  DialOptions dialOptions() const;
  const std::vector<std::string>& robotNames() const { return stage_->exhibit.robot_names; }
  int port() const { return server_->ports().front(); }

  /// Whether a step is being taken, and not yet done.
  bool isStepping() const { return is_stepping_; }

  /// Ends the run unless it has ended, and waits for its end.
  Served end();
  /// Waits for the run's own end, or that a control panel stops it.
  Served wait();
  /// After the end, or while the run is paused.
  std::string digest() const { return stage_->run.environment().digest(); }
  const State& state() const { return stage_->run.environment().state(); }

  std::string log() const;
  /// Waits until the log has `text`, so many times.
  void waitForLog(const std::string& text, std::size_t times = 1);

 private:
  struct Stage {
    std::vector<std::uint8_t> networked;
    LocalRun run;
    Exhibit exhibit;
    Stage(LoadedWorld world, const WorldSource& source, const Options& options);
  };
  Environment& environment() override { return stage_->run.environment(); }
  std::shared_ptr<const Exhibit> exhibit() const override { return {stage_, &stage_->exhibit}; }
  void decide() override {
    stage_->run.decide();
    is_stepping_ = true;
  }
  void stepped(std::size_t) override { is_stepping_ = false; }
  bool isOver() const override { return stage_->run.environment().time().step >= options_.last_step; }
  void load(const WorldSource& source) override;

  Options options_;
  mutable std::mutex mutex_;
  std::condition_variable bell_;
  std::string log_;
  bool is_asked_to_end_ = false;
  std::atomic<bool> is_stepping_{false};
  std::shared_ptr<Stage> stage_;
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
