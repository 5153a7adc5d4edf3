#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/log_limiter.h"
#include "net/access.h"
#include "net/audit.h"
#include "remote/remote_control_robot.h"
#include "ros/messages.h"
#include "run/local_run.h"

namespace robosim {

/// A program that drives robots, by one of the protocols that RoboSim serves.
struct RobotDriver {
  std::string protocol;                   ///< "Foxglove", "ROS 2"
  std::uint64_t id = 0;                   ///< another one for each program of the protocol
  std::string peer;                       ///< where it is, for logs
  std::optional<Identity> identity = {};  ///< that rights are checked of; nullopt: the protocol has checked them

  bool isSame(const RobotDriver& other) const { return id == other.id && protocol == other.protocol; }
  /// "anna by Foxglove"; "ROS 2"
  std::string name() const { return identity ? identity->name() + " by " + protocol : protocol; }
};

/// Drives robots of a run by messages of programs on /<robot>/cmd_vel, under the rules of remote control
/// (RemoteControlRobot): the driver's token must permit it; a robot has one driver, whatever its protocol; without a
/// message of its driver for RemoteControlRobot::Options::dead_man it stops; its limits apply. The first message takes
/// the robot from its controller, which continues when /<robot>/autonomous is set. Another driver takes over when the
/// former has left, or has been silent for that time.
///
/// begin() and addRobots() are called by the thread that steps the run; all other functions are thread-safe.
class RobotDrivers {
 public:
  using Clock = RemoteControlRobot::Clock;

  /// @param log takes one line; thread-safe
  RobotDrivers(Access access, const std::function<void(const std::string&)>& log,
               std::function<Clock::time_point()> now = Clock::now);

  /// Drives the robots of this run, and no longer those of the one before, which must still exist.
  /// @param why_not_driven by robot: why it cannot be driven; empty if its controller is in this process
  void begin(LocalRun& run, const std::vector<std::string>& why_not_driven);
  /// Drives the robots that have been added to the run, too. @param why_not_driven as begin(), of all robots
  void addRobots(LocalRun& run, const std::vector<std::string>& why_not_driven);

  /// The parameters /<robot>/autonomous, and whether the robot is.
  std::vector<std::pair<std::string, bool>> autonomous() const;
  bool hasParameter(const std::string& name) const;
  /// @return why not; empty when it is so
  std::string setAutonomous(const RobotDriver& driver, const std::string& parameter, bool on);

  /// The topics by which robots can be driven, "/Pioneer1/cmd_vel".
  std::vector<std::string> topics() const;
  /// Why a program cannot drive by a topic; empty if it can, once no other program does.
  std::string whyNot(const RobotDriver& driver, const std::string& topic) const;
  /// Applies linear.x [m/s] and angular.z [rad/s]. @return why the command has no effect; empty if it has
  std::string drive(const RobotDriver& driver, const std::string& topic, const ros::Twist& twist);
  /// The program will not drive by the topic any more.
  void leave(const RobotDriver& driver, const std::string& topic);

 private:
  struct Driven {
    std::string name;
    std::string why_not;                         ///< it cannot be driven
    std::shared_ptr<RemoteControlRobot> remote;  ///< null: it cannot be driven
    std::optional<RobotDriver> driver;
    Clock::time_point last_message;
  };
  void wrapNew(LocalRun& run, const std::vector<std::string>& why_not_driven);
  const Driven* find(const std::string& topic) const;
  std::string fault(const RobotDriver& driver, const Driven* robot) const;
  std::string refusal(const RobotDriver& driver, const Driven* robot) const;

  Access access_;
  std::function<Clock::time_point()> now_;
  LogLimiter log_;
  AuditLog audit_;
  mutable std::mutex mutex_;
  std::map<std::string, Driven> by_topic_;       ///< guarded by the mutex, as the following
  std::map<std::string, std::string> topic_of_;  ///< by parameter
};

}  // namespace robosim
