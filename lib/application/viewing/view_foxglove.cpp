#include "viewing/view_foxglove.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <thread>
#include <utility>

#include "base/interrupt.h"
#include "base/log.h"
#include "base/seconds.h"
#include "environment/model.h"
#include "environment/state.h"

namespace robosim {
namespace {

/// Between two looks at clients and source.
constexpr std::chrono::milliseconds kNap(10);

/// The snapshots of a source as states of a run, without commands.
class ShownRun {
 public:
  explicit ShownRun(const ViewSource& source)
      : source_(source),
        model_(std::make_shared<const Model>(source.world().world, source.world().fleet)),
        state_(initialState(*model_, RobotRange{0, 0})) {
    update();
  }

  const std::shared_ptr<const Model>& model() const { return model_; }
  const State& state() const { return state_; }

  /// Takes over the source's snapshot.
  void update() {
    const RunSnapshot& snapshot = source_.snapshot();
    const double since_s = snapshot.time_s - std::exchange(time_s_, snapshot.time_s);
    state_.time = timeOf(snapshot);
    state_.objects = snapshot.objects;
    state_.won.reset();
    for (std::size_t i = 0; i < state_.activity.size(); ++i) {
      const RobotSnapshot* const robot = i < snapshot.robots.size() ? &snapshot.robots[i] : nullptr;
      const bool was_present = !state_.isAbsent(i);
      // A robot without readings has not been recorded yet.
      if (!robot || !robot->isPresent() || !robot->readings) {
        state_.activity[i] = Activity::absent;
        continue;
      }
      // A snapshot has no velocity; after a longer time, the way there is not known.
      constexpr double kLongest_s = 1;
      const bool follows = was_present && since_s > 0 && since_s <= kLongest_s;
      const RobotVelocity velocity =
          follows ? velocityBetween(state_.world_from_robot[i], robot->world_from_robot, since_s) : RobotVelocity();
      const double period_s = state_.time.period_s;
      state_.last_motion[i] = {velocity.speed_mps * period_s, velocity.turn_radps * period_s,
                               velocity.lateral_mps * period_s};
      state_.activity[i] = robot->activity;
      state_.world_from_robot[i] = robot->world_from_robot;
      state_.laser_pan_rad[i] = robot->laser_pan_rad;
      state_.stalled[i] = robot->stalled;
      state_.readings[i] = *robot->readings;
      state_.readings[i].time = state_.time;
      noteWinner(state_.readings[i].winner);
    }
  }

 private:
  /// That of the readings; in recordings of other programs, which have no steps, microseconds.
  static SimTime timeOf(const RunSnapshot& snapshot) {
    for (const auto& robot : snapshot.robots) {
      if (robot.readings && std::abs(robot.readings->time.seconds() - snapshot.time_s) < 1e-9)
        return robot.readings->time;
    }
    constexpr double kMicrosecond_s = 1e-6;
    return {static_cast<std::uint64_t>(std::llround(std::max(0.0, snapshot.time_s) / kMicrosecond_s)), kMicrosecond_s};
  }

  void noteWinner(const std::string& name) {
    if (name.empty() || state_.won) return;
    const auto& robots = model_->fleet.robots;
    const auto winner =
        std::find_if(robots.begin(), robots.end(), [&](const FleetRobot& robot) { return robot.info.name == name; });
    if (winner != robots.end())
      state_.won = RobotAtStep{static_cast<std::size_t>(winner - robots.begin()), state_.time.step};
  }

  const ViewSource& source_;
  std::shared_ptr<const Model> model_;
  State state_;
  double time_s_ = 0;
};

std::string whyNotOperated(const ViewSource& source) {
  if (source.canPlay()) return "";
  return source.isOver() ? "nothing runs here" : "robosim view has no token that permits it";
}

/// A source and its clients.
class ServedView {
 public:
  ServedView(ViewSource& source, const FoxgloveOptions& options, const ViewTimes& times)
      : source_(source),
        times_(times),
        drivers_(options.server.access, options.server.log),
        serving_(options, drivers_) {
    options.server.log(foxgloveLine(options.server, serving_.port()));
    if (source_.duration()) {
      source_.seek(times.from_s.value_or(0));
      source_.setSpeed(times.speed.value_or(1));
      source_.advance(0);
    }
    begin();
  }

  void serve(const Interrupt& interrupt) {
    using Clock = std::chrono::steady_clock;
    Clock::time_point last = Clock::now();
    while (!interrupt.isRequested()) {
      handleRequests();
      const auto now = Clock::now();
      advance(toSeconds(now - std::exchange(last, now)));
      if (times_.to_s && source_.duration() && source_.snapshot().time_s >= *times_.to_s) source_.pause(true);
      std::this_thread::sleep_for(kNap);
    }
  }

 private:
  void begin() {
    world_number_ = source_.worldNumber();
    refusal_ = whyNotOperated(source_);
    duration_s_ = source_.duration();
    shown_ = std::make_unique<ShownRun>(source_);
    serving_.begin({.model = shown_->model(),
                    .state = shown_->state(),
                    .id = std::to_string(std::random_device()()),
                    .topics = {.form = {}, .has_commands = false, .leaves_out_equal = source_.isOfOtherProgram()},
                    .duration_s = duration_s_,
                    .why_not_operated = refusal_});
  }

  void handleRequests() {
    const bool can_play = source_.canPlay();
    RunControl control{
        .is_paused = can_play && source_.isPaused(), .steps_left = steps_left_, .speed = source_.speed()};
    const RunControl before = control;
    serving_.poll(control, {});
    if (!can_play) return;
    if (control.is_paused != before.is_paused) source_.pause(control.is_paused);
    if (control.speed != before.speed) source_.setSpeed(control.speed);
    if (const auto time_s = serving_.takeSeek()) {
      source_.seek(*time_s);
      advance(0, true);
    }
    // One in each round: a client receives the messages of all.
    steps_left_ = source_.isOver() ? 0 : control.steps_left;
    if (steps_left_ == 0) return;
    --steps_left_;
    source_.step();
    advance(0);
  }

  /// @param is_sent whether the snapshot is sent also if it is the one before
  void advance(double wall_s, bool is_sent = false) {
    if (!source_.advance(wall_s) && !is_sent) return;
    // A world that has changed is another run; a run that is over can no longer be paused.
    if (source_.worldNumber() != world_number_ || source_.duration() != duration_s_ ||
        whyNotOperated(source_) != refusal_) {
      return begin();
    }
    shown_->update();
    serving_.stepped();
  }

  ViewSource& source_;
  ViewTimes times_;
  RobotDrivers drivers_;  ///< of no robots
  std::unique_ptr<ShownRun> shown_;
  FoxgloveServing serving_;
  std::uint64_t steps_left_ = 0;
  int world_number_ = 0;
  std::string refusal_;
  std::optional<double> duration_s_;
};

}  // namespace

void serveView(ViewSource& source, FoxgloveOptions options, const ViewTimes& times) {
  const Interrupt interrupt;
  options.is_realtime = source.duration().has_value();  // the speed of a recording has a limit
  if (const auto remark = source.remark(); !remark.empty()) logWarning("view", remark);
  ServedView(source, options, times).serve(interrupt);
}

}  // namespace robosim
