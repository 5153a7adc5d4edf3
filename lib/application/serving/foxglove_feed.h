#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "environment/environment.h"
#include "foxglove/hub.h"
#include "recording/kept_readings.h"
#include "run/outputs/world_topics.h"
#include "topics/robot_topics.h"

namespace robosim {

/// Sends the topics of a run to Foxglove's clients: those of its recordings as MCAP (doc/ros2.md). Messages are made
/// for topics with subscribers only. A client that subscribes first receives the present state. It reads the run and
/// never changes it.
class FoxgloveFeed {
 public:
  /// @param hub, environment must outlive this
  FoxgloveFeed(foxglove::Hub& hub, const Environment& environment);

  /// In the order of their indices in the hub.
  std::vector<foxglove::Channel> channels() const;
  /// Sends the present state to new subscribers. To be called between steps.
  void poll();
  /// Sends the messages of a step.
  void stepped();
  /// By robot: whether a client receives its pictures. Empty for none.
  std::vector<std::uint8_t> pictured() const;

 private:
  class Sink;
  using Audience = foxglove::Hub::Audience;

  std::size_t channelOf(const Topic& topic);
  void send(const TopicMessage& message, Audience audience, bool latest_only = false);
  void sendRobots(Audience audience);
  void sendLatched();
  bool isWanted(std::size_t robot, Audience audience) const;

  foxglove::Hub& hub_;
  const Environment& environment_;
  std::vector<Topic> topics_;                      ///< by channel
  std::map<std::string, std::size_t> channel_of_;  ///< by topic
  std::vector<RobotTopics> robots_;
  std::vector<std::vector<std::size_t>> channels_of_robot_;  ///< by robot and topic
  std::vector<std::vector<std::size_t>> pictures_of_robot_;  ///< channels with pictures
  std::vector<KeptReadings> kept_;
  std::vector<std::uint8_t> was_absent_;  ///< by robot
  WorldTopics world_;
  std::size_t clock_ = 0, static_transforms_ = 0, map_ = 0, objects_ = 0, interventions_ = 0, events_ = 0;
};

}  // namespace robosim
