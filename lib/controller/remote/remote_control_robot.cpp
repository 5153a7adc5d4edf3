#include "remote/remote_control_robot.h"

#include <utility>
#include <variant>

#include "base/portable_math.h"
#include "net/robot_wire.h"

namespace robosim {
namespace {

const Odometry* odometryOf(const Readings& readings) {
  for (const auto& measurement : readings.measurements) {
    if (const auto* odometry = std::get_if<Odometry>(&measurement)) return odometry;
  }
  return nullptr;
}

}  // namespace

/// The controller's view of the robot: it is frozen during remote control.
class RemoteControlRobot::ControllersView final : public Hardware {
 public:
  explicit ControllersView(Hardware& hardware) : hardware_(hardware), command_(hardware.lastCommand()) {}

  const RobotInfo& info() const override { return hardware_.info(); }
  const std::vector<std::string>& robots() const override { return hardware_.robots(); }
  const Readings& readings() const override { return held_.empty() ? hardware_.readings() : readings_; }
  void command(const Command& command) override {
    command_ = command;
    hardware_.command(command);
  }
  void send(const std::string& to, const std::string& text) override { hardware_.send(to, text); }
  void broadcast(const std::string& text) override { hardware_.broadcast(text); }
  RefereeLink* referee() override { return hardware_.referee(); }
  BaseLink* base() override { return hardware_.base(); }

  const Command& lastCommand() const override { return command_; }

  /// Stores the messages of a step in which the controller is suspended.
  void skipStep() {
    const auto& inbox = hardware_.readings().inbox;
    held_.insert(held_.end(), inbox.begin(), inbox.end());
  }
  /// The controller continues: its last command, and the messages received meanwhile.
  void resume() {
    hardware_.command(command_);
    if (held_.empty()) return;
    readings_ = hardware_.readings();
    std::vector<RobotMessage>& kept = readings_.inbox.edit();
    kept.insert(kept.begin(), held_.begin(), held_.end());
  }
  /// The controller has received the stored messages.
  void finishStep() { held_.clear(); }

 private:
  Hardware& hardware_;
  Command command_;                 ///< of the controller; that of the robot is the driver's during remote control
  std::vector<RobotMessage> held_;  ///< messages received while the controller was suspended
  Readings readings_;               ///< this step's, with the messages held; unused without such messages
};

RemoteControlRobot::RemoteControlRobot(Hardware& hardware, std::unique_ptr<Controller> controller,
                                       const Options& options)
    : hardware_(hardware),
      controller_(std::move(controller)),
      options_(options),
      view_(std::make_unique<ControllersView>(hardware)),
      robot_(*view_),
      filter_(hardware.info().type->limits, options.dead_man) {}

RemoteControlRobot::~RemoteControlRobot() = default;

void RemoteControlRobot::step() {
  const Odometry* const odometry = odometryOf(hardware_.readings());
  const bool is_moving =
      odometry && (odometry->speed_mps != 0 || odometry->turn_radps != 0 || odometry->lateral_mps != 0);
  bool autonomous = true;
  bool wants_check_win = false;
  Command driven;
  {
    const std::lock_guard lock(mutex_);
    autonomous = state_.autonomous();
    wants_check_win = std::exchange(wants_check_win_, false);
    const auto now = options_.now();
    is_moving_ = is_moving;
    // Without odometry, the driver judges by eye whether the robot stands, and steers again.
    if (autonomous || (odometry ? !is_moving : order_.has_value())) filter_.endStop();
    if (!autonomous) {
      const std::string before = filter_.whyStopped();
      if (order_) filter_.obey(*order_, order_received_);
      driven = filter_.command(now, state_.driver());
      logStop(before);
    }
    order_.reset();
  }
  if (RefereeLink* referee = hardware_.referee(); wants_check_win && referee) referee->checkWin();
  if (autonomous) {
    if (!std::exchange(was_autonomous_, true)) view_->resume();
    controller_->step(robot_);
    view_->finishStep();
  } else {
    was_autonomous_ = false;
    view_->skipStep();
    driven.activity = view_->lastCommand().activity;  // final once the controller has halted
    driven.grip = hardware_.lastCommand().grip;       // the driver has no order for this and those that follow
    driven.led_color = hardware_.lastCommand().led_color;
    driven.camera_head = hardware_.lastCommand().camera_head;
    hardware_.command(driven);
  }
  const Command& commanded = autonomous ? view_->lastCommand() : driven;
  const std::lock_guard lock(mutex_);
  state_.set_speed_mps(commanded.speed_mps);
  state_.set_turn_radps(commanded.turn_radps);
  state_.set_lateral_mps(commanded.lateral_mps);
  state_.set_activity(encode(commanded.activity));
  const Readings& readings = hardware_.readings();
  state_.set_winner(*readings.winner);
  if (!readings.winner.empty()) {
    state_.set_activity(readings.winner == name() ? v1::ACTIVITY_FOUND : v1::ACTIVITY_HALTED);
  }
  if (readings.is_too_far) state_.set_win_refusals(state_.win_refusals() + 1);
  state_.set_stalled(readings.stalled);
  addDriven(readings);
}

/// Adds the distance driven since the last step.
/// @pre holds the mutex
void RemoteControlRobot::addDriven(const Readings& readings) {
  const Odometry* const odometry = odometryOf(readings);
  if (!odometry) return;
  const auto& now = odometry->odom_from_robot;
  const auto last = std::exchange(odom_from_robot_, now);
  state_.set_driven_m(state_.driven_m() + (last ? portable::hypot(now.x - last->x, now.y - last->y) : 0));
}

void RemoteControlRobot::take(const std::string& driver, bool autonomous) {
  const std::lock_guard lock(mutex_);
  state_.set_driver(driver);
  setMode(autonomous, options_.now());
}

void RemoteControlRobot::setAutonomous(bool autonomous) { obey(modeOrder(autonomous)); }

/// @pre holds the mutex
void RemoteControlRobot::setMode(bool autonomous, Clock::time_point now) {
  state_.set_autonomous(autonomous);
  order_.reset();
  filter_.begin(now);
}

void RemoteControlRobot::obey(const v1::ControlRequest& order) {
  const OrderType type = typeOf(order);
  const std::lock_guard lock(mutex_);
  const auto now = options_.now();
  filter_.noteMessage(now);
  switch (rowOf(type).rule) {
    case OrderRule::mode:
      if (state_.autonomous() != order.set_mode().autonomous()) setMode(order.set_mode().autonomous(), now);
      break;
    case OrderRule::set:
    case OrderRule::steer:
      // A DRIVE only sets values, so that it may take effect before the order that follows it in the same step.
      if (order_ && order_->has_drive() && !state_.autonomous()) filter_.obey(*order_, order_received_);
      order_ = order;
      order_received_ = now;
      break;
    case OrderRule::stop:
      stop(order, now);
      break;
    case OrderRule::at_once:
      if (type == OrderType::check_win) wants_check_win_ = true;
      break;
    case OrderRule::request:
      break;
  }
}

/// Takes effect at once: an order that follows within the same step must not supersede it. A stop that the driver has
/// requested, which has no reason, ends the autonomous mode.
/// @pre holds the mutex
void RemoteControlRobot::stop(const v1::ControlRequest& order, Clock::time_point now) {
  order_.reset();
  if (state_.autonomous()) {
    if (!whyOf(order).empty()) return;
    setMode(false, now);
    filter_.obey(order, now);
    options_.log(name() + " stops, and is no longer autonomous");
    return;
  }
  const std::string before = filter_.whyStopped();
  filter_.obey(order, now);
  logStop(before);
}

void RemoteControlRobot::release(const std::string& why) {
  const std::lock_guard lock(mutex_);
  order_.reset();
  const std::string before = filter_.whyStopped();
  if (!state_.autonomous()) filter_.release(why);
  logStop(before);
  state_.clear_driver();
}

/// Logs the reason of a new stop.
/// @pre holds the mutex
void RemoteControlRobot::logStop(const std::string& before) {
  if (filter_.whyStopped() != before && !filter_.whyStopped().empty()) {
    options_.log(name() + " stops: " + filter_.whyStopped());
  }
}

bool RemoteControlRobot::isAutonomous() const {
  const std::lock_guard lock(mutex_);
  return state_.autonomous();
}

v1::RobotState RemoteControlRobot::state() const {
  const std::lock_guard lock(mutex_);
  v1::RobotState state = state_;
  state.set_why_stopped(filter_.whyStopped());
  state.set_stops(filter_.stops());
  state.set_is_stopping(!state.autonomous() && filter_.isStopping() && is_moving_);
  return state;
}

}  // namespace robosim
