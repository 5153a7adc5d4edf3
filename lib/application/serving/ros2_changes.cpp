#include "serving/ros2_changes.h"

#include <cmath>
#include <utility>

#include "base/error_list.h"
#include "ros/cdr.h"
#include "serving/ros2_outlet.h"
#include "topics/robot_topics.h"

namespace robosim {
namespace {

constexpr const char* kRefused = "changes of ROS 2";  ///< kind of log lines

const std::string& checkedText(const ros::String& message) {
  if (message.data.size() > Ros2Changes::kMaxTextBytes) {
    throw ConfigError("a text of " + std::to_string(message.data.size()) + " bytes; the most is " +
                      std::to_string(Ros2Changes::kMaxTextBytes));
  }
  return message.data;
}

}  // namespace

PlaceBody placeOf(const std::string& robot, const ros::PoseWithCovarianceStamped& message) {
  const std::string& frame = message.header.frame_id;
  if (!frame.empty() && frame != "map") throw ConfigError("a pose in the frame " + frame + "; it must be in map");
  const auto& [position, q] = message.pose.pose;
  const double squared_length = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  const bool is_valid =
      std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(squared_length) && squared_length > 0;
  if (!is_valid) throw ConfigError("a pose whose position or orientation is no finite number");
  return {robot, position.x, position.y, yawOf(q)};
}

Ros2Changes::Ros2Changes(dds::Participant& participant, std::string name_space, std::string peer,
                         const std::function<void(const std::string&)>& log)
    : participant_(participant), name_space_(std::move(name_space)), peer_(std::move(peer)), log_(log), audit_(log) {
  of_world_.push_back(reader<ros::String>("/robosim/spawn", [](const ros::String& message) {
    return parseChange("<add>" + checkedText(message) + "</add>", "spawn");
  }));
  of_world_.push_back(reader<ros::String>(
      "/robosim/remove", [](const ros::String& message) -> Change { return RemoveBody{checkedText(message)}; }));
}

template <ros::Message M, typename ChangeOf>
std::unique_ptr<dds::Reader> Ros2Changes::reader(const std::string& topic, const ChangeOf& change_of) {
  const Topic read{ros2TopicName(name_space_, topic), &ros::typeOf<M>(), TopicDelivery::steady};
  return participant_.read(read, dds::Receipt::reliable, [this, topic, change_of](const dds::Sample& sample) {
    try {
      request(change_of(ros::decode<M>(sample.message)));
    } catch (const ConfigError& error) {
      log_.write(kRefused, topic + " of ROS 2 has no effect: " + error.what());
    }
  });
}

void Ros2Changes::request(Change change) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() < kMaxWaiting) {
      waiting_.push_back(std::move(change));
      return;
    }
  }
  log_.write(kRefused, "a change of ROS 2 is dropped: " + std::to_string(kMaxWaiting) + " already wait");
}

void Ros2Changes::addRobots(const std::vector<std::string>& names) {
  for (const auto& name : names) {
    const std::string topic = "/" + topicNamePart(name) + "/initialpose";
    auto& made = of_robot_[topic];
    if (made) continue;
    made = reader<ros::PoseWithCovarianceStamped>(
        topic, [name](const ros::PoseWithCovarianceStamped& message) -> Change { return placeOf(name, message); });
  }
}

void Ros2Changes::clear() {
  of_robot_.clear();
  const std::lock_guard lock(mutex_);
  waiting_.clear();
}

void Ros2Changes::poll(const Intervene& intervene) {
  std::vector<Change> changes;
  {
    const std::lock_guard lock(mutex_);
    changes.swap(waiting_);
  }
  for (const auto& change : changes) {
    const std::string text = changeText(change);
    audit_.write({}, peer_, text);
    if (const std::string fault = intervene({"ROS 2", change}); !fault.empty()) {
      log_.write(kRefused, text + " of ROS 2 has no effect: " + fault);
    }
  }
}

}  // namespace robosim
