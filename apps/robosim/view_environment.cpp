#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "robosim/run_operator.h"
#include "robosim/view_source.h"
#include "server/viewer.h"

namespace robosim {
namespace {

/// A thread waits for the newest step, so that the window never does.
class EnvironmentView final : public ViewSource {
 public:
  explicit EnvironmentView(const ConnectionArguments& connection)
      : address_(connection.environment),
        dialled_(connection.dialOptions()),
        viewer_(dialled_, ReadingsWish{.of_all = true, .of = {}}),
        world_(viewer_.sight().world),
        shown_(toShown(viewer_.sight())) {
    if (viewer_.sight().may_operate) operator_ = std::make_unique<RunOperator>(dialled_);
    waiting_ = std::thread([this] { wait(); });
  }
  ~EnvironmentView() override {
    viewer_.leave();
    waiting_.join();
  }

  const LoadedWorld& world() const override { return world_; }
  int worldNumber() const override { return world_number_; }
  const Shown& shown() const override { return shown_; }
  std::string title() const override { return address_; }

  bool advance(double) override {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    if (!next_) return false;
    shown_ = std::move(*next_);
    next_.reset();
    if (next_world_) {
      world_ = std::move(*next_world_);
      next_world_.reset();
      ++world_number_;
    }
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
  void want(const std::vector<std::uint8_t>& robots) override {
    ReadingsWish wish{.of_all = robots.empty(), .of = {}};
    for (std::size_t i = 0; i < robots.size(); ++i) {
      if (robots[i]) wish.of.push_back(static_cast<std::uint32_t>(i));
    }
    viewer_.want(wish);
  }

 private:
  static Shown toShown(const Sight& sight) {
    Shown shown;
    shown.step = sight.step;
    shown.time_s = sight.time_s;
    for (std::size_t i = 0; i < sight.robots.size(); ++i) {
      const RobotLook& robot = sight.robots[i];
      const Readings* readings = sight.readingsOf(i);
      shown.robots.push_back({robot.world_from_robot, robot.laser_pan_rad, robot.stalled, robot.activity,
                              readings ? std::make_optional(*readings) : std::nullopt});
    }
    return shown;
  }

  void wait() {
    try {
      while (viewer_.look()) {
        Shown shown = toShown(viewer_.sight());
        const std::lock_guard lock(mutex_);
        next_ = std::move(shown);
        if (viewer_.isOtherWorld()) next_world_ = viewer_.sight().world;
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }

  std::string address_;
  DialOptions dialled_;
  Viewer viewer_;
  LoadedWorld world_;
  int world_number_ = 0;
  Shown shown_;
  std::unique_ptr<RunOperator> operator_;  ///< null for who may only look

  mutable std::mutex mutex_;  ///< of what follows
  std::optional<Shown> next_;
  std::optional<LoadedWorld> next_world_;
  bool is_over_ = false;
  std::exception_ptr failure_;
  std::thread waiting_;
};

}  // namespace

std::unique_ptr<ViewSource> viewEnvironment(const ConnectionArguments& connection) {
  return std::make_unique<EnvironmentView>(connection);
}

}  // namespace robosim
