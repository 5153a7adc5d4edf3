#include "serving/ros2_serving.h"

#include <utility>

#include "ros/cdr.h"
#include "ros/messages.h"

namespace robosim {

Ros2Serving::Ros2Serving(const Ros2Options& options, RobotDrivers& drivers)
    : options_(options),
      drivers_(drivers),
      log_(options.dds.log),
      participant_(options.join(options.dds)),
      outlet_(*participant_, options.name_space) {
  if (options.may_supervise) changes_.emplace(*participant_, options.name_space, peer(), options.dds.log);
}

Ros2Serving::~Ros2Serving() {
  if (const auto lost = participant_->lost(); lost > 0) {
    options_.dds.log("ROS 2: " + std::to_string(lost) + " messages were lost");
  }
}

void Ros2Serving::begin(const Environment& environment) {
  environment_ = &environment;
  readers_.clear();
  if (changes_) changes_->clear();
  offer(true);
}

void Ros2Serving::addRobots() { offer(false); }

void Ros2Serving::offer(bool is_another_run) {
  feed_.emplace(outlet_, environment_->model(), environment_->state(), FeedOptions{.form = options_.form});
  outlet_.offer(feed_->topics(), is_another_run);
  if (changes_) changes_->addRobots(environment_->robotNames());
  if (!options_.may_drive) return;
  for (const auto& topic : drivers_.topics()) {
    if (readers_.count(topic) > 0) continue;
    readCommands<ros::Twist>(topic, [](const ros::Twist& twist) { return twist; });
    readCommands<ros::TwistStamped>(topic, [](const ros::TwistStamped& stamped) { return stamped.twist; });
  }
}

/// Reads commands of one type. The readers take what is lost as lost: a later command replaces it.
template <ros::Message M, typename TwistOf>
void Ros2Serving::readCommands(const std::string& topic, const TwistOf& twist_of) {
  const Topic read{ros2TopicName(options_.name_space, topic), &ros::typeOf<M>(), TopicDelivery::steady};
  readers_[topic].push_back(participant_->read(
      read, dds::Receipt::best_effort, [this, topic, twist_of, peer = peer()](const dds::Sample& sample) {
        const ros::Twist twist = twist_of(ros::decode<M>(sample.message));
        const std::string why = drivers_.drive({"ROS 2", sample.writer, peer}, topic, twist);
        if (!why.empty()) log_.write("commands of ROS 2", topic + " of ROS 2 has no effect: " + why);
      }));
}

void Ros2Serving::poll(const Intervene& intervene) {
  if (changes_) changes_->poll(intervene);
  feed_->poll();
}

/// Where programs of ROS 2 are, for logs.
std::string Ros2Serving::peer() const { return "domain " + std::to_string(options_.dds.domain); }

}  // namespace robosim
