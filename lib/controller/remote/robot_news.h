#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "hardware/readings.h"
#include "hardware/robot_info.h"
#include "remote/orders.h"

namespace robosim {

/// All measurements of a robot in one step.
struct RobotUpdate {
  Readings readings;  ///< without camera pictures: see RobotPicture
  v1::RobotState state = initialState();
};

/// A camera's picture, separate because cameras do not take one in every step.
struct RobotPicture {
  std::uint64_t step = 0;
  std::string jpeg;
};

/// The requested reading of one sensor.
struct RobotAnswer {
  std::uint64_t step = 0;
  std::size_t sensor = 0;  ///< index among the robot's sensors
  bool has_sensor = false;
  Measurement measurement;
};

/// Newest state of a robot as received by a remote control. The shared values are immutable.
struct RobotNews {
  bool is_up = false;
  /// Its program has ended the call because its run is over, and has not returned since: not a failure.
  bool is_over = false;
  std::string problem{};     ///< why it is disconnected, where, and how to fix it
  bool was_refused = false;  ///< the robot's port refused the connection, so that an early retry is useless
  std::shared_ptr<const RobotInfo> info{};  ///< null as long as it has never been up
  std::string world{};
  double period_s = 0;
  v1::RobotState state = initialState();
  std::shared_ptr<const RobotUpdate> update{};                          ///< null as long as there is none
  std::shared_ptr<const RobotPicture> picture{};                        ///< of the first camera
  std::array<std::shared_ptr<const RobotAnswer>, kReadings> answers{};  ///< by readingIndex()
};

/// A robot of a team, as seen by its remote control.
struct TeamRobot {
  std::string name;
  std::string address;  ///< "host:port"
  RobotNews news;

  /// Whether it can become the primary: connected, and without another driver.
  bool isFit() const { return news.is_up && (news.state.is_yours() || news.state.driver().empty()); }
};

}  // namespace robosim
