#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "hardware/readings.h"
#include "hardware/robot_info.h"
#include "net/dial.h"
#include "net/remote_wire.h"

namespace robosim {

/// What a robot measured in a step, all of it.
struct RobotUpdate {
  Readings readings;  ///< of a camera, nothing: see RobotPicture
  RemoteState state;
};

/// A camera's picture. It is kept apart, for cameras take fewer of them than there are steps.
struct RobotPicture {
  std::uint64_t step = 0;
  std::string jpeg;
};

/// One sensor's reading that was asked for.
struct RobotAnswer {
  std::uint64_t step = 0;
  std::size_t sensor = 0;  ///< its place among the robot's
  bool has_sensor = false;
  Measurement measurement;
};

/// What a remote control knows of a robot: the newest of each, each a value that never changes.
struct RobotNews {
  bool is_up = false;
  std::string problem{};     ///< why it is down: what, where and the mend
  bool was_refused = false;  ///< the robot's end does not want us, so that calling again is of little use
  std::shared_ptr<const RobotInfo> info{};  ///< null as long as it has never been up
  std::string world{};
  double period_s = 0;
  RemoteState state{};
  std::shared_ptr<const RobotUpdate> update{};                  ///< null as long as there is none
  std::shared_ptr<const RobotPicture> picture{};                ///< of the first camera
  std::array<std::shared_ptr<const RobotAnswer>, 3> answers{};  ///< heat, laser, sonar
};

/// A remote control's end of the connection with one robot (remote.proto). Nothing waits: orders go out as the
/// connection takes them, of several that steer the newest; what comes in is there when it is asked for. All may be
/// called from any thread.
class RobotLink {
 public:
  /// @param dialled where and how; `address` is the robot's remote port
  /// @param ring called from other threads when there is news
  RobotLink(std::string robot, DialOptions dialled, std::function<void()> ring);
  ~RobotLink();
  RobotLink(const RobotLink&) = delete;
  RobotLink& operator=(const RobotLink&) = delete;

  /// Calls the robot, unless there is a call already.
  void connect();
  /// Whether there is a call, up or not yet up.
  bool isCalling() const;
  /// Says who we are, and that we want the robot: at once, and again after each connect().
  void claim(const std::string& driver, bool autonomous);
  /// Of a robot that is down only INIT_ACK is kept, for its next INIT.
  void send(const RemoteOrder& order);
  /// Whether updates and pictures are to keep coming.
  void setLive(bool live);

  RobotNews news() const;

 private:
  class Call;
  struct Shared;
  DialOptions dialled_;
  std::shared_ptr<Shared> shared_;
};

}  // namespace robosim
