#pragma once
#include <string>

#include "foxglove/hub.h"
#include "serving/robot_drivers.h"

namespace robosim {

/// The client as a driver of robots.
RobotDriver driverOf(const foxglove::Client& client);

/// Passes the messages that Foxglove's clients publish on /<robot>/cmd_vel (geometry_msgs Twist or TwistStamped, as CDR
/// or JSON) to the drivers of the robots.
class FoxgloveCommands final : public foxglove::PublicationHandler {
 public:
  /// @param drivers must outlive this
  explicit FoxgloveCommands(RobotDrivers& drivers) : drivers_(drivers) {}

  std::string advertised(const foxglove::Client& client, const foxglove::ClientChannel& channel) override;
  std::string published(const foxglove::Client& client, const foxglove::Publication& publication) override;
  void withdrawn(const foxglove::Client& client, const foxglove::ClientChannel& channel) override;

 private:
  RobotDrivers& drivers_;
};

}  // namespace robosim
