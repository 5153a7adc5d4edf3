#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "environment/model.h"
#include "environment/state.h"
#include "recording/kept_readings.h"
#include "run/outputs/world_topics.h"
#include "serving/topic_outlet.h"
#include "topics/robot_markers.h"
#include "topics/robot_topics.h"

namespace robosim {

/// The topics of a feed.
struct FeedOptions {
  TopicForm form;
  bool has_commands = true;       ///< the state has the commands of the robots: cmd_vel
  bool leaves_out_equal = false;  ///< KeptReadings, by equality
};

/// Passes the topics of a run to an outlet: those of its recordings as MCAP (doc/ros2.md). Messages are made for topics
/// with receivers only. A new receiver first gets the present state. It reads the run and never changes it.
class TopicFeed {
 public:
  /// @param outlet, state must outlive this @param state has the robots of the model, the first ones
  TopicFeed(TopicOutlet& outlet, std::shared_ptr<const Model> model, const State& state,
            const FeedOptions& options = {});

  const std::vector<Topic>& topics() const { return topics_; }
  /// Passes the present state to new receivers. To be called between steps.
  void poll();
  /// Passes the messages of a step.
  void stepped();
  /// The next step does not follow the last one: it is sent as the first is.
  void restart();
  /// By robot: whether its pictures are received. Empty for none.
  std::vector<std::uint8_t> pictured() const;

 private:
  class Sink;
  using Audience = TopicOutlet::Audience;

  std::size_t indexOf(const Topic& topic);
  void send(TopicMessage message, Audience audience, bool latest_only = false);
  void sendRobots(Audience audience);
  void sendMarkers(Audience audience);
  void sendLatched(Audience audience);
  void sendMounts(std::span<const RobotTopics> robots, Audience audience, std::uint64_t time_ns);
  bool isWanted(std::size_t robot, Audience audience) const;

  TopicOutlet& outlet_;
  std::shared_ptr<const Model> model_;
  const State& state_;
  FeedOptions options_;
  bool is_restarted_ = false;
  std::vector<Topic> topics_;
  std::map<std::string, std::size_t> index_of_;  ///< by the topic's name
  std::vector<RobotTopics> robots_;
  std::vector<std::vector<std::size_t>> topics_of_robot_;    ///< by robot and its topic
  std::vector<std::vector<std::size_t>> pictures_of_robot_;  ///< topics with pictures
  std::vector<KeptReadings> kept_;
  std::vector<std::uint8_t> was_absent_;  ///< by robot
  WorldTopics world_;
  RobotMarkers markers_;
  std::size_t markers_topic_ = 0, clock_ = 0, map_ = 0, objects_ = 0, interventions_ = 0, events_ = 0;
};

}  // namespace robosim
