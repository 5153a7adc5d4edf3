#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "control/controller.h"
#include "hardware/hardware.h"
#include "remote/helm.h"

namespace robosim {

/// A robot that obeys either its own controller or a person at a remote control (2005: RemoteControlRobot), whichever
/// type it is. It may be switched while it drives: the new master commands from the next step on, and the robot's
/// limits on acceleration see to it that it does not jump.
///
/// While a person drives, the controller rests. What robots have written meanwhile it finds in its inbox when it has
/// the robot again, as if the letters had just come, and its last command is given once more.
///
/// A robot begins autonomous. step() is for the thread that steps the robot; all else may be called from any thread.
class RemoteControlRobot {
 public:
  using Clock = Helm::Clock;

  struct Options {
    Clock::duration dead_man = Helm::kDeadMan;  ///< how long the driver may be silent
    std::function<Clock::time_point()> now = Clock::now;
    std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line
  };

  /// @param hardware must outlive this
  RemoteControlRobot(Hardware& hardware, std::unique_ptr<Controller> controller, const Options& options);
  ~RemoteControlRobot();

  const Hardware& hardware() const { return hardware_; }
  const std::string& name() const { return hardware_.info().name; }

  /// Once a time step, after sensing: the master of the moment decides. Never waits for anybody.
  void step();

  /// @name What a remote control does; it is for its port to see to it that there is one at a time
  ///@{
  /// A driver takes the robot, and lets its controller drive, or not.
  void take(const std::string& driver, bool autonomous);
  void setAutonomous(bool autonomous);
  /// Steers, or asks whether the robot has won. Of several orders to steer within one step the newest counts.
  void obey(const RemoteOrder& order);
  /// The driver has gone: a robot that they drove stands. Its controller, if it has the robot, goes on.
  void release(const std::string& why);
  ///@}

  RemoteState state() const;

 private:
  class ControllersView;
  void tellStop(const std::string& before);

  Hardware& hardware_;
  std::unique_ptr<Controller> controller_;
  Options options_;
  std::unique_ptr<ControllersView> view_;
  Robot robot_;  ///< as its controller knows it
  mutable std::mutex mutex_;
  /// @name Touched with the mutex held
  ///@{
  Helm helm_;
  RemoteState state_;
  std::optional<RemoteOrder> order_;  ///< the newest that steers
  Clock::time_point order_came_;
  bool asks_for_win_ = false;
  ///@}
  bool was_autonomous_ = true;  ///< in the last step
};

}  // namespace robosim
