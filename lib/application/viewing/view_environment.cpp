#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "client/viewer.h"
#include "rendering/snapshot_run.h"
#include "viewing/run_operator.h"
#include "viewing/run_supervisor.h"
#include "viewing/view_source.h"

namespace robosim {
namespace {

/// Receives steps in a thread, so that the window never blocks.
class EnvironmentView final : public ViewSource {
 public:
  explicit EnvironmentView(const ConnectOptions& connect_options)
      : connect_options_(connect_options),
        supervisor_(connect_options_),
        viewer_(connect_options_, ReadingsSelection{.of_all = true, .of = {}}),
        world_(viewer_.run().world),
        snapshot_(viewer_.run().snapshot) {
    paths_.add(snapshot_);
    addEvents(events_, world_.fleet, snapshot_);
    if (viewer_.run().may_operate) operator_ = std::make_unique<RunOperator>(connect_options_);
    waiting_ = std::thread([this] { wait(); });
  }
  ~EnvironmentView() override {
    viewer_.leave();
    waiting_.join();
  }

  const LoadedWorld& world() const override { return world_; }
  int worldNumber() const override { return world_number_; }
  const RunSnapshot& snapshot() const override { return snapshot_; }
  const RunPaths& paths() const override { return paths_; }
  const RunEvents& events() const override { return events_; }
  std::string title() const override { return connect_options_.address; }

  bool advance(double) override {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    if (!next_) return false;
    snapshot_ = std::move(*next_);
    next_.reset();
    if (next_world_) {
      world_ = std::move(*next_world_);
      next_world_.reset();
      ++world_number_;
      paths_.clear();
      events_.clear();
    }
    for (const auto& step : next_steps_) paths_.add(step.step, step.time_s, step.world_from_robot);
    next_steps_.clear();
    addEvents(events_, world_.fleet, snapshot_);
    return true;
  }
  bool isOver() const override {
    const std::lock_guard lock(mutex_);
    return is_over_ && !next_;
  }
  std::string remark() const override { return isOver() ? "the run is over" : ""; }

  bool canPlay() const override { return operator_ && !isOver(); }
  bool isPaused() const override { return operator_ && operator_->isPaused(); }
  void pause(bool paused) override { operator_->pause(paused); }
  void step() override { operator_->step(); }
  double speed() const override { return operator_ ? operator_->speed() : 1; }
  void setSpeed(double speed) override { operator_->setSpeed(speed); }
  std::string whyUnchangeable() const override { return isOver() ? "the run is over" : supervisor_.refusal(); }
  void change(const Change& change) override { supervisor_.request(change); }
  std::vector<std::string> takeAnswers() override { return supervisor_.takeAnswers(); }
  void requestReadings(const std::vector<std::uint8_t>& robots) override {
    ReadingsSelection request{.of_all = robots.empty(), .of = {}};
    for (std::size_t i = 0; i < robots.size(); ++i) {
      if (robots[i]) request.of.push_back(static_cast<std::uint32_t>(i));
    }
    viewer_.select(request);
  }

 private:
  /// Poses of a received step, for the paths.
  struct Step {
    std::uint64_t step;
    double time_s;
    std::vector<mrpt::math::TPose2D> world_from_robot;  ///< RobotSnapshot::shownPose()
  };

  void wait() {
    try {
      while (viewer_.waitForFrame()) {
        RunSnapshot snapshot = viewer_.run().snapshot;
        const std::lock_guard lock(mutex_);
        if (viewer_.isNewWorld()) {
          next_world_ = viewer_.run().world;
          next_steps_.clear();
        }
        Step& step = next_steps_.emplace_back(Step{snapshot.step, snapshot.time_s, {}});
        for (const auto& robot : snapshot.robots) step.world_from_robot.push_back(robot.shownPose());
        next_ = std::move(snapshot);
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }

  ConnectOptions connect_options_;
  RunSupervisor supervisor_;
  Viewer viewer_;
  LoadedWorld world_;
  int world_number_ = 0;
  RunSnapshot snapshot_;
  RunPaths paths_;
  RunEvents events_;
  std::unique_ptr<RunOperator> operator_;  ///< null for read-only access

  mutable std::mutex mutex_;  ///< guards the members below
  std::optional<RunSnapshot> next_;
  std::vector<Step> next_steps_;  ///< received since the last advance()
  std::optional<LoadedWorld> next_world_;
  bool is_over_ = false;
  std::exception_ptr failure_;
  std::thread waiting_;
};

}  // namespace

std::unique_ptr<ViewSource> viewEnvironment(const ConnectOptions& connect_options) {
  return std::make_unique<EnvironmentView>(connect_options);
}

}  // namespace robosim
