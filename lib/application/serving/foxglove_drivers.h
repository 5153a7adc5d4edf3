#pragma once
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/log_limiter.h"
#include "foxglove/hub.h"
#include "net/access.h"
#include "net/audit.h"
#include "remote/remote_control_robot.h"
#include "run/local_run.h"

namespace robosim {

/// Drives robots of a run by the messages on /<robot>/cmd_vel of Foxglove's clients (geometry_msgs Twist or
/// TwistStamped, as CDR or JSON), under the rules of remote control (RemoteControlRobot): the token must permit it; a
/// robot has one driver; without a message of its driver for RemoteControlRobot::Options::dead_man it stops; its limits
/// apply. The first message takes the robot from its controller, which continues when /<robot>/autonomous is set.
/// Another client takes over when the driver has left, or has been silent for that time.
///
/// begin() and addRobots() are called by the thread that steps the run; all other functions are thread-safe.
class FoxgloveDrivers final : public foxglove::PublicationHandler {
 public:
  using Clock = RemoteControlRobot::Clock;

  /// @param log takes one line; thread-safe
  FoxgloveDrivers(Access access, const std::function<void(const std::string&)>& log,
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
  std::string setAutonomous(const foxglove::Client& client, const std::string& parameter, bool on);

  std::string advertised(const foxglove::Client& client, const foxglove::ClientChannel& channel) override;
  std::string published(const foxglove::Client& client, const foxglove::Publication& publication) override;
  void withdrawn(const foxglove::Client& client, const foxglove::ClientChannel& channel) override;

 private:
  struct Driven {
    std::string name;
    std::string why_not;                         ///< it cannot be driven
    std::shared_ptr<RemoteControlRobot> remote;  ///< null: it cannot be driven
    std::optional<foxglove::Client> driver;
    Clock::time_point last_message;
  };
  void wrapNew(LocalRun& run, const std::vector<std::string>& why_not_driven);
  std::string refusal(const foxglove::Client& client, const Driven* robot) const;

  Access access_;
  std::function<Clock::time_point()> now_;
  LogLimiter log_;
  AuditLog audit_;
  mutable std::mutex mutex_;
  std::map<std::string, Driven> by_topic_;       ///< guarded by the mutex, as the following
  std::map<std::string, std::string> topic_of_;  ///< by parameter
};

}  // namespace robosim
