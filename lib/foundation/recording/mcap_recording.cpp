#include "recording/mcap_recording.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/error_list.h"
#include "recording/recording_error.h"

namespace robosim {

/// The messages of a step of a robot.
class McapRecording::ChannelSink final : public TopicSink {
 public:
  ChannelSink(mcap::Writer& writer, const std::vector<std::uint16_t>& channels, std::uint64_t time_ns)
      : writer_(writer), channels_(channels), time_ns_(time_ns) {}

  std::vector<std::uint8_t>& beginMessage(std::size_t topic) override {
    return writer_.beginMessage(channels_[topic], time_ns_);
  }
  void endMessage() override { writer_.endMessage(); }
  void put(std::size_t topic, std::span<const std::uint8_t> message) override {
    writer_.write(channels_[topic], time_ns_, message);
  }

 private:
  mcap::Writer& writer_;
  const std::vector<std::uint16_t>& channels_;
  std::uint64_t time_ns_;
};

McapRecording::McapRecording(const std::filesystem::path& file, std::span<const RobotInfo> robots,
                             std::uint64_t start_ns, RosDistribution distribution)
    : distribution_(distribution),
      file_(file),
      writer_([this](std::span<const std::uint8_t> bytes) { file_.write(bytes); }, {"ros2", "robosim"}) {
  // rosbag2 reads the numbers of offeredQos() only in files with this record, whose content may be empty.
  writer_.addMetadata({"rosbag2", {{"serialized_metadata", ""}}});
  rawlog_ = channelOf({kRawlogTopic, &ros::typeOf<ros::UInt8MultiArray>(), TopicDelivery::steady});
  markers_channel_ = channelOf(RobotMarkers::topic());
  clock_ = channelOf({"/clock", &ros::typeOf<ros::Clock>(), TopicDelivery::steady});
  try {
    for (const auto& robot : robots) addTopics(robot);
  } catch (const std::length_error& error) {
    throw ConfigError(file.string() + ": has a topic for each sensor of each robot, and " + error.what() +
                      "; record a .rawlog, or fewer robots");
  }
  writeMounts(start_ns);
}

void McapRecording::addTopics(const RobotInfo& robot) {
  const RobotTopics& topics = topics_.emplace_back(robot, TopicForm{.distribution = distribution_});
  auto& channels = channels_of_robot_.emplace_back();
  markers_.add(robot);
  poses_.resize(markers_.size());
  for (const auto& topic : topics.topics()) channels.push_back(channelOf(topic));
}

void McapRecording::writeMounts(std::uint64_t time_ns) {
  const bool have_mounts =
      std::any_of(topics_.begin(), topics_.end(), [](const auto& topics) { return !topics.mounts().empty(); });
  if (have_mounts) write(staticTransforms(topics_, time_ns));
}

void McapRecording::addRobot(const RobotInfo& robot, std::uint64_t time_ns) {
  try {
    addTopics(robot);
  } catch (const std::length_error& error) {
    throw RecordingError(path().string() + ": robot '" + robot.name + "' cannot be added: " + error.what() +
                         "; record a .rawlog");
  }
  writeMounts(time_ns);
}

std::uint16_t McapRecording::channelOf(const Topic& topic) {
  if (const auto known = channels_.find(topic.name); known != channels_.end()) return known->second;
  auto schema = schemas_.find(topic.type->name);
  if (schema == schemas_.end()) {
    const std::uint16_t id = writer_.addSchema({0, topic.type->name, "ros2msg", topic.type->definition()});
    schema = schemas_.emplace(topic.type->name, id).first;
  }
  const std::uint16_t channel =
      writer_.addChannel({0,
                          schema->second,
                          topic.name,
                          "cdr",
                          {{"offered_qos_profiles", topic.offeredQos()}, {"topic_type_hash", topic.type->hash()}}});
  channels_[topic.name] = channel;
  return channel;
}

void McapRecording::writeRawlog(std::span<const std::uint8_t> bytes, std::uint64_t time_ns) {
  auto& message = writer_.beginMessage(rawlog_, time_ns);
  // As CdrWriter writes UInt8MultiArray, in one copy.
  ros::CdrWriter writer(message);
  writer.write(ros::MultiArrayLayout());
  writer.write(static_cast<std::uint32_t>(bytes.size()));
  message.insert(message.end(), bytes.begin(), bytes.end());
  writer_.endMessage();
}

void McapRecording::endStep(std::uint64_t time_ns) {
  if (has_poses_) writer_.write(markers_channel_, time_ns, markers_.message(poses_, time_ns));
  poses_.assign(markers_.size(), std::nullopt);
  ros::encode(ros::Clock{timeOf(time_ns)}, writer_.beginMessage(clock_, time_ns));
  writer_.endMessage();
}

void McapRecording::write(std::size_t robot, const Readings& readings, const std::optional<RobotTruth>& truth,
                          const std::optional<Command>& command, std::span<const std::uint8_t> kept) {
  ChannelSink sink(writer_, channels_of_robot_[robot], nanosecondsOf(readings.time.seconds()));
  poses_[robot] = truth ? std::optional(truth->world_from_robot) : std::nullopt;
  has_poses_ |= truth.has_value();
  topics_[robot].write(readings, truth, command, kept, sink);
}

void McapRecording::write(const TopicMessage& message) {
  writer_.write(channelOf(message.topic), message.time_ns, message.data);
}

void McapRecording::finish() {
  writer_.finish();
  file_.finish();
}

}  // namespace robosim
