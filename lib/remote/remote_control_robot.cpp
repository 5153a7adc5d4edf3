#include "remote/remote_control_robot.h"

#include <utility>

namespace robosim {

/// The robot as its controller sees it: nothing happens to it while a person drives.
class RemoteControlRobot::ControllersView final : public Hardware {
 public:
  explicit ControllersView(Hardware& hardware) : hardware_(hardware) {}

  const RobotInfo& info() const override { return hardware_.info(); }
  const Readings& readings() const override { return held_.empty() ? hardware_.readings() : readings_; }
  void command(const Command& command) override {
    command_ = command;
    hardware_.command(command);
  }
  void send(const std::string& to, const std::string& text) override { hardware_.send(to, text); }
  void checkWin() override { hardware_.checkWin(); }

  const Command& lastCommand() const { return command_; }

  /// A step that the controller does not see.
  void rest() {
    const auto& inbox = hardware_.readings().inbox;
    held_.insert(held_.end(), inbox.begin(), inbox.end());
  }
  /// It has the robot again.
  void wake() {
    hardware_.command(command_);
    if (held_.empty()) return;
    readings_ = hardware_.readings();
    readings_.inbox.insert(readings_.inbox.begin(), held_.begin(), held_.end());
  }
  /// It has seen the step.
  void done() { held_.clear(); }

 private:
  Hardware& hardware_;
  Command command_;
  std::vector<RobotMessage> held_;  ///< what came while it rested
  Readings readings_;               ///< this step's, with what was held; while there is any
};

RemoteControlRobot::RemoteControlRobot(Hardware& hardware, std::unique_ptr<Controller> controller,
                                       const Options& options)
    : hardware_(hardware),
      controller_(std::move(controller)),
      options_(options),
      view_(std::make_unique<ControllersView>(hardware)),
      robot_(*view_),
      helm_(hardware.info().limits, options.dead_man) {}

RemoteControlRobot::~RemoteControlRobot() = default;

void RemoteControlRobot::step() {
  bool autonomous = true;
  bool asks_for_win = false;
  Command driven;
  {
    const std::lock_guard lock(mutex_);
    autonomous = state_.autonomous;
    asks_for_win = std::exchange(asks_for_win_, false);
    const auto now = options_.now();
    if (!autonomous) {
      const std::string before = helm_.whyStopped();
      if (order_) helm_.obey(*order_, order_came_);
      driven = helm_.command(now, state_.driver);
      tellStop(before);
    }
    order_.reset();
  }
  if (asks_for_win) hardware_.checkWin();
  if (autonomous) {
    if (!std::exchange(was_autonomous_, true)) view_->wake();
    controller_->step(robot_);
    view_->done();
  } else {
    was_autonomous_ = false;
    view_->rest();
    driven.activity = view_->lastCommand().activity;  // final, if it has halted
    hardware_.command(driven);
  }
  const Command& commanded = autonomous ? view_->lastCommand() : driven;
  const std::lock_guard lock(mutex_);
  state_.speed_mps = commanded.speed_mps;
  state_.turn_radps = commanded.turn_radps;
  state_.activity = commanded.activity;
  const Readings& readings = hardware_.readings();
  state_.winner = readings.winner;
  if (!readings.winner.empty()) state_.activity = readings.winner == name() ? Activity::found : Activity::halted;
  if (readings.is_too_far) ++state_.win_refusals;
}

void RemoteControlRobot::take(const std::string& driver, bool autonomous) {
  const std::lock_guard lock(mutex_);
  state_.driver = driver;
  state_.autonomous = autonomous;
  order_.reset();
  helm_.begin(options_.now());
}

void RemoteControlRobot::setAutonomous(bool autonomous) {
  const std::lock_guard lock(mutex_);
  helm_.hear(options_.now());
  if (state_.autonomous == autonomous) return;
  state_.autonomous = autonomous;
  order_.reset();
  helm_.begin(options_.now());
}

void RemoteControlRobot::obey(const RemoteOrder& order) {
  const std::lock_guard lock(mutex_);
  const auto now = options_.now();
  helm_.hear(now);
  switch (order.type) {
    case RemoteType::accelerate:
    case RemoteType::decelerate:
    case RemoteType::turn_left:
    case RemoteType::turn_right:
    case RemoteType::drive:
    case RemoteType::stop:
      order_ = order;
      order_came_ = now;
      break;
    case RemoteType::check_win:
      asks_for_win_ = true;
      break;
    default:
      break;
  }
}

void RemoteControlRobot::release(const std::string& why) {
  const std::lock_guard lock(mutex_);
  order_.reset();
  const std::string before = helm_.whyStopped();
  if (!state_.autonomous) helm_.release(why);
  tellStop(before);
  state_.driver.clear();
}

/// Says why the robot has just been stopped, if it has.
/// @pre holds the mutex
void RemoteControlRobot::tellStop(const std::string& before) {
  if (helm_.whyStopped() != before && !helm_.whyStopped().empty()) {
    options_.log(name() + " stops: " + helm_.whyStopped());
  }
}

RemoteState RemoteControlRobot::state() const {
  const std::lock_guard lock(mutex_);
  RemoteState state = state_;
  state.why_stopped = helm_.whyStopped();
  return state;
}

}  // namespace robosim
