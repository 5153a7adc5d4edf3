#pragma once
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "aria/robot_list.h"
#include "remote/robot_link.h"

namespace robosim {

/// Queue of robots whose head is the primary, driven by a person, while the others run autonomously. On a switch the
/// old primary goes to the tail, and the next fit robot becomes the head; skipped robots keep their positions (2005:
/// without skipping, the next robot).
class PrimaryQueue {
 public:
  /// @param robots number of robots, identified by index in the robot list
  /// @param primary the first head; the others follow in the list's order
  PrimaryQueue(std::size_t robots, std::size_t primary);

  std::size_t primary() const { return order_.front(); }
  /// The primary first.
  const std::vector<std::size_t>& order() const { return order_; }

  /// The next fit robot; nullopt when none besides the primary is fit.
  std::optional<std::size_t> next(const std::function<bool(std::size_t)>& is_fit) const;
  /// Moves the old primary to the tail and `robot` to the head. No effect if it is the primary.
  void switchTo(std::size_t robot);

 private:
  std::vector<std::size_t> order_;
};

/// Remote control of a team of robots (2005: RemoteControl), independent of the input device. Connects to the secondary
/// robots first and sets them autonomous, then to the primary, which waits for its driver. Subscribes to the primary's
/// updates, requests the heat of the others once per second, and reconnects robots once per second. Not thread-safe.
class RemoteControl {
 public:
  using Clock = std::chrono::steady_clock;
  using Robot = TeamRobot;

  struct Options {
    std::string driver = "the remote control";  ///< name shown to others
    ConnectOptions connect_options;             ///< all but the address
    std::function<void()> on_news = [] {};      ///< called from other threads when there is news
    std::function<Clock::time_point()> now = Clock::now;
  };

  /// @throws ConfigError for a token that would cross the network in clear text.
  RemoteControl(const std::vector<RobotAddress>& list, const Options& options);
  ~RemoteControl();
  RemoteControl(const RemoteControl&) = delete;
  RemoteControl& operator=(const RemoteControl&) = delete;

  /// Connects robots that are due; to be called about ten times per second.
  void tick();

  /// In the order of the queue: the primary first.
  std::vector<Robot> robots() const;
  Robot primary() const;

  /// Makes the next robot that is fit the primary. @return false when there is none
  bool switchPrimary();
  /// Makes a robot the primary. @return false when there is none of that name, or it is not fit
  bool switchTo(const std::string& name);
  /// Sets the driver's name; the primary stands until the new driver steers it.
  void setDriver(const std::string& driver);
  /// Sends an order to the primary.
  void send(const v1::ControlRequest& order);

 private:
  struct TeamMember;
  Robot robotAt(std::size_t index) const;
  void connect(TeamMember& member, bool autonomous);
  bool areSecondariesSettled() const;
  void requestHeat(Clock::time_point now);
  void makePrimary(std::size_t index);
  void claimPrimary();

  Options options_;
  std::vector<std::unique_ptr<TeamMember>> members_;  ///< in the list's order
  PrimaryQueue primaries_;
  Clock::time_point started_;
  Clock::time_point heat_requested_{};
  bool has_connected_primary_ = false;
};

}  // namespace robosim
