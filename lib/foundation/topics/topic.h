#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ros/cdr.h"
#include "ros/message_type.h"
#include "ros/messages.h"

namespace robosim {

/// Delivery of a topic's messages. All are reliable, which serves readers of either kind.
enum class TopicDelivery {
  steady,      ///< keep last 10
  sensor,      ///< keep last 5
  transforms,  ///< keep last 100
  latched,     ///< keep last 1, also for readers that come later (transient local)
};

/// A topic of ROS 2.
struct Topic {
  std::string name;  ///< "/Pioneer1/scan"
  const ros::MessageType* type = nullptr;
  TopicDelivery delivery = TopicDelivery::steady;

  /// Number of messages that a writer or reader keeps.
  int depth() const;
  /// The delivery as rosbag2 stores it: a list of YAML with the numbers of ROS's enumerations.
  std::string offeredQos() const;
  bool operator==(const Topic&) const = default;
};

/// An encoded message.
struct TopicMessage {
  Topic topic;
  std::uint64_t time_ns = 0;
  std::vector<std::uint8_t> data;
};

template <ros::Message M>
TopicMessage topicMessage(std::string name, TopicDelivery delivery, std::uint64_t time_ns, const M& message) {
  TopicMessage made{{std::move(name), &ros::typeOf<M>(), delivery}, time_ns, {}};
  ros::encode(message, made.data);
  return made;
}

/// A text as part of a topic's name or a frame's: other characters than letters, digits and _ become _, and one that
/// begins with a digit gets a _ before it.
std::string topicNamePart(const std::string& text);

/// Nanoseconds of a time in seconds, rounded.
std::uint64_t nanosecondsOf(double time_s);
ros::Time timeOf(std::uint64_t time_ns);
/// Nanoseconds since the beginning of the clock; negative before it.
std::int64_t nanosecondsOf(const ros::Time& time);

}  // namespace robosim
