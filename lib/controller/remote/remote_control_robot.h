#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <mrpt/math/TPose2D.h>

#include "control/controller.h"
#include "hardware/hardware.h"
#include "remote/drive_command_filter.h"

namespace robosim {

/// Multiplexes a robot between its own controller and a remote control (2005: RemoteControlRobot), for any robot type.
/// The source of commands may change while the robot drives: the new source applies from the next step, and the robot's
/// limits on acceleration prevent jumps.
///
/// The controller is suspended during remote control. Afterwards its inbox contains the messages received meanwhile,
/// and its last command is repeated.
///
/// Initially autonomous. step() must be called by the thread that steps the robot; all other functions are thread-safe.
class RemoteControlRobot {
 public:
  using Clock = DriveCommandFilter::Clock;

  struct Options {
    Clock::duration dead_man = DriveCommandFilter::kDeadMan;  ///< maximum time without a message of the driver
    std::function<Clock::time_point()> now = Clock::now;
    std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line
  };

  /// @param hardware must outlive this
  RemoteControlRobot(Hardware& hardware, std::unique_ptr<Controller> controller, const Options& options);
  ~RemoteControlRobot();

  const Hardware& hardware() const { return hardware_; }
  const std::string& name() const { return hardware_.info().name; }

  /// Applies the active source's command; called once per time step, after sensing. Does not block.
  void step();

  /// @name Operations of a remote control; the caller ensures that there is only one
  ///@{
  /// Assigns a driver, and selects autonomous or remote control.
  void take(const std::string& driver, bool autonomous);
  void setAutonomous(bool autonomous);
  /// Applies an order. Of several steering orders within one step the newest applies; a value
  /// that a DRIVE omits is taken from an earlier DRIVE. STOP takes effect at once, so that no later order supersedes
  /// it. A STOP without a reason, which the driver has requested, ends the autonomous mode; a STOP with one, for
  /// example because the driver's page is hidden, has no effect on an autonomous robot.
  void obey(const v1::ControlRequest& order);
  /// Removes the driver: a remotely driven robot stops, an autonomous one continues.
  void release(const std::string& why);
  ///@}

  v1::RobotState state() const;
  bool isAutonomous() const;

 private:
  class ControllersView;
  void setMode(bool autonomous, Clock::time_point now);
  void stop(const v1::ControlRequest& order, Clock::time_point now);
  void logStop(const std::string& before);
  void addDriven(const Readings& readings);

  Hardware& hardware_;
  std::unique_ptr<Controller> controller_;
  Options options_;
  std::unique_ptr<ControllersView> view_;
  Robot robot_;  ///< as its controller sees it
  mutable std::mutex mutex_;
  /// @name Guarded by the mutex
  ///@{
  DriveCommandFilter filter_;
  v1::RobotState state_ = initialState();
  std::optional<v1::ControlRequest> order_;  ///< the newest that steers
  Clock::time_point order_received_;
  bool wants_check_win_ = false;
  bool is_moving_ = false;  ///< by the odometry of the last step
  ///@}
  bool was_autonomous_ = true;                          ///< in the last step
  std::optional<mrpt::math::TPose2D> odom_from_robot_;  ///< in the last step
};

}  // namespace robosim
