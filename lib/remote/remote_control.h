#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "remote/robot_link.h"
#include "remote/robot_list.h"
#include "remote/rota.h"

namespace robosim {

/// The remote control of a team of robots (2005: RemoteControl), whatever a person drives it with: connects to every
/// secondary robot first and sets it autonomous, then to the primary, which waits for its driver. The primary's updates
/// keep coming. Calls those that are down again, once a second. Used by one thread.
class RemoteControl {
 public:
  using Clock = std::chrono::steady_clock;

  struct Options {
    std::string driver = "the remote control";  ///< its name for others
    DialOptions dial;                           ///< all but the address
    std::function<void()> ring = [] {};         ///< called from other threads when there is news
    std::function<Clock::time_point()> now = Clock::now;
  };

  /// One robot as it stands.
  struct Robot {
    std::string name;
    std::string address;  ///< "host:port"
    RobotNews news;

    /// Whether it can be made the primary: up, and nobody else's.
    bool isFit() const { return news.is_up && (news.state.is_yours || news.state.driver.empty()); }
  };

  /// @throws ConfigError for a token that would cross the network in clear text.
  RemoteControl(const std::vector<RobotAddress>& list, const Options& options);
  ~RemoteControl();

  /// Calls whom it is time to call: some ten times a second.
  void tick();

  /// In the row's order: the primary first.
  std::vector<Robot> robots() const;
  Robot primary() const;

  /// The next that is fit becomes the primary. @return false when there is none
  bool switchPrimary();
  /// That robot becomes the primary. @return false when there is none of that name, or it is not fit
  bool switchTo(const std::string& name);
  /// Another driver has the remote control: the primary stands until they steer it.
  void setDriver(const std::string& driver);
  /// Asks for the primary again, after somebody else has had it.
  void claimPrimary();
  /// To the primary.
  void send(const RemoteOrder& order);
  void setAutonomous(bool autonomous);

 private:
  struct Seat;
  Robot robotAt(std::size_t seat) const;
  void call(Seat& seat, bool autonomous);
  bool areSecondariesSettled() const;
  void makePrimary(std::size_t seat);

  Options options_;
  std::vector<std::unique_ptr<Seat>> seats_;  ///< in the list's order
  Rota rota_;
  Clock::time_point begun_;
  bool has_called_primary_ = false;
};

}  // namespace robosim
