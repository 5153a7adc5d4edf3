#pragma once
#include <functional>
#include <memory>
#include <string>

#include "net/connect.h"
#include "remote/orders.h"
#include "remote/robot_news.h"

namespace robosim {

/// Client of the RemoteControl service for one robot (remote.proto). No function blocks: orders are sent when the
/// connection accepts them, of several steering orders the newest; received state is stored until it is queried.
/// Thread-safe.
class RobotLink {
 public:
  /// @param connect_options where and how; `address` is the robot's remote port
  /// @param on_news called from other threads when there is news
  RobotLink(std::string robot, ConnectOptions connect_options, std::function<void()> on_news);
  ~RobotLink();
  RobotLink(const RobotLink&) = delete;
  RobotLink& operator=(const RobotLink&) = delete;

  /// Starts a call to the robot, unless there is one.
  void connect();
  /// Whether there is a call, established or not.
  bool isCalling() const;
  /// Sends the driver's name and claims the robot: now, and after each connect(). Orders that steer and have not been
  /// sent yet are discarded.
  void claim(const std::string& driver, bool autonomous);
  /// Sends an order. While disconnected, only a change of the mode is kept, for the next INIT.
  /// @throws WireError for a message that is no order of kOrders
  void send(const v1::ControlRequest& order);
  /// Subscribes to updates and pictures, or unsubscribes.
  void setLive(bool live);

  RobotNews news() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
