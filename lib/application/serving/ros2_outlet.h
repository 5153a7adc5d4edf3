#pragma once
#include <cstdint>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dds/participant.h"
#include "serving/topic_outlet.h"
#include "topics/topic.h"

namespace robosim {

/// "/team" for "team" or "/team"; "" for "". @throws ConfigError unless ROS 2 permits it as a namespace
std::string ros2Namespace(const std::string& text);
/// The name of a topic in a namespace: "/team/robot1/scan". /clock, /tf and /tf_static are the same in all of them.
std::string ros2TopicName(const std::string& name_space, const std::string& topic);

/// Writes the topics of a run to ROS 2. It does not write /<robot>/cmd_vel, where others command robots. A reader of a
/// latched topic that has come since the last round is fresh; others receive the next message.
class Ros2Outlet final : public TopicOutlet {
 public:
  /// @param participant must outlive this @param name_space as of ros2Namespace()
  Ros2Outlet(dds::Participant& participant, std::string name_space)
      : participant_(participant), name_space_(std::move(name_space)) {}

  /// Replaces the topics. Writers of topics that stay remain.
  /// @param is_another_run whether the state is another one: readers receive it again
  void offer(const std::vector<Topic>& topics, bool is_another_run);

  bool wants(std::size_t topic, Audience audience) const override;
  bool isSubscribed(std::size_t topic) const override;
  bool hasFresh() const override;
  void beginRound(std::uint64_t time_ns) override;
  void send(std::size_t topic, Audience audience, std::uint64_t time_ns, std::vector<std::uint8_t> message,
            bool latest_only) override;
  void endRound() override;

 private:
  struct Sent {
    Topic topic;
    std::unique_ptr<dds::Writer> writer;
    std::uint64_t arrivals = 0;  ///< of readers that have received the state
    std::uint64_t in_round = 0;  ///< arrivals at the begin of the round
    bool isLatched() const { return topic.delivery == TopicDelivery::latched; }
  };

  dds::Participant& participant_;
  std::string name_space_;
  std::map<std::string, Sent> sent_;  ///< by the name of the topic
  std::future<void> ending_;          ///< of writers whose topics are no longer offered
  std::vector<Sent*> of_topic_;       ///< null: not written
};

}  // namespace robosim
