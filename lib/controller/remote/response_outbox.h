#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "net/robot_wire.h"
#include "remote/orders.h"
#include "remote/remote_control_robot.h"

namespace robosim {

/// A robot of a remote port, with the newest picture of each camera, which a remote control that misses steps must not
/// miss.
class PortRobot {
 public:
  struct Picture {
    std::optional<std::uint64_t> step;  ///< none before its first picture
    Image image;
  };

  /// @param robot must outlive this
  explicit PortRobot(RemoteControlRobot& robot) : robot_(&robot), pictures_(robot.hardware().info().sensors->size()) {}

  RemoteControlRobot& robot() const { return *robot_; }
  const RobotInfo& info() const { return robot_->hardware().info(); }
  const Readings& readings() const { return robot_->hardware().readings(); }
  /// By sensor; empty for all but cameras.
  const std::vector<Picture>& pictures() const { return pictures_; }
  /// Stores this step's pictures.
  void keepPictures();
  /// Deletes pictures older than `steps`: while no remote control shows the robot, its cameras may take none.
  void dropPicturesBefore(std::uint64_t steps);

 private:
  RemoteControlRobot* robot_;
  std::vector<Picture> pictures_;
};

/// Messages that wait for one remote control: at most one per topic, the newest, so that a slow remote control receives
/// fewer. Readings are added only on request. Not thread-safe.
class ResponseOutbox {
 public:
  /// Steps after a request of all readings in which the remote control is assumed to show them.
  static constexpr int kWatchingSteps = 50;

  /// @param robot must outlive this
  /// @param welcome description, for the first state
  ResponseOutbox(const PortRobot& robot, RobotsWelcome welcome);

  /// Requests the next step's reading. @return false if the order is not a request
  bool request(OrderType type);
  /// Requests all readings of the next step.
  void requestAll() { is_requested_[kAll] = true; }
  /// Adds the robot's state.
  /// @param is_driver whether the remote control is the robot's driver
  void addState(bool is_driver);
  /// Adds the requested readings of this step.
  /// @param received message from which the robot's readings were decoded: it is forwarded. Null: they are encoded
  void addReadings(bool is_driver, const v1::RobotReadings* received = nullptr);
  /// Whether all readings have been requested in one of the last steps: a remote control that shows them requests them
  /// again when it has received them.
  bool isWatching() const { return is_requested_[kAll] || steps_since_all_ < kWatchingSteps; }
  bool isEmpty() const;
  /// Moves the next message to `out`: the state first. @pre not isEmpty()
  void takeNext(v1::ControlResponse& out);

 private:
  /// Topics, in the order in which messages are sent: the state, each kind of reading, and all readings.
  static constexpr std::size_t kState = 0, kFirstReading = 1, kAll = kFirstReading + kReadings, kTopics = kAll + 1;

  v1::ControlResponse& add(std::size_t topic, bool is_driver);
  void addSensor(std::size_t reading, bool is_driver, const v1::RobotReadings* received);
  void addAll(bool is_driver, const v1::RobotReadings* received);
  void noteSent(v1::Measurement& measurement, std::size_t sensor);

  const PortRobot& robot_;
  int steps_since_all_ = kWatchingSteps;  ///< since the last request of all readings, at most kWatchingSteps
  std::optional<RobotsWelcome> welcome_;  ///< until it was taken
  std::array<bool, kTopics> is_requested_{}, is_due_{};
  std::array<v1::ControlResponse, kTopics> due_;
  std::vector<std::optional<std::uint64_t>> sent_;  ///< by sensor: the step of the last measurement taken
};

}  // namespace robosim
