#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/command.h"
#include "hardware/readings.h"
#include "hardware/robot_info.h"
#include "mcap/writer.h"
#include "recording/recording_file.h"
#include "topics/robot_markers.h"
#include "topics/robot_topics.h"

namespace robosim {

/// Topic with the content of a rawlog, as the data of std_msgs/msg/UInt8MultiArray (kRawlogDataOffset): one message for
/// each step, and one for each group of comments. Their data in a row are the bytes of the rawlog, not compressed
/// (doc/decisions/mcap.md).
inline constexpr const char* kRawlogTopic = "/robosim/rawlog";
/// Position of the first byte of the rawlog in an encoded message: header, empty layout, and length.
inline constexpr std::size_t kRawlogDataOffset = 16;

/// A recording as an MCAP file (profile ros2): the topics of the robots, and the rawlog (doc/ros2.md).
class McapRecording {
 public:
  /// @throws ConfigError when the file cannot be created, or for more robots than an MCAP file has channels
  McapRecording(const std::filesystem::path& file, std::span<const RobotInfo> robots, std::uint64_t start_ns,
                RosDistribution distribution = RosDistribution::jazzy);

  /// Adds a robot, with the next index, from this time on. @throws RecordingError also when channels are exhausted
  void addRobot(const RobotInfo& robot, std::uint64_t time_ns);
  /// Bytes of the rawlog. @throws RecordingError as RecordingFile::write() does, as all that follow
  void writeRawlog(std::span<const std::uint8_t> bytes, std::uint64_t time_ns);
  /// Messages of a robot in a step, by its index.
  void write(std::size_t robot, const Readings& readings, const std::optional<RobotTruth>& truth,
             const std::optional<Command>& command, std::span<const std::uint8_t> kept);
  /// Completes a step: the robots' markers, if their poses are known, and the clock.
  void endStep(std::uint64_t time_ns);
  void write(const TopicMessage& message);
  void attach(const mcap::Attachment& attachment) { writer_.attach(attachment); }
  void addMetadata(const mcap::Metadata& metadata) { writer_.addMetadata(metadata); }

  /// Completes the file; it is still "<name>.part".
  void finish();
  void commit() { file_.commit(); }
  const std::filesystem::path& path() const { return file_.path(); }

 private:
  /// Writes messages of a robot to its channels.
  class ChannelSink;

  std::uint16_t channelOf(const Topic& topic);
  /// @throws std::length_error
  void addTopics(const RobotInfo& robot);
  void writeMounts(std::uint64_t time_ns);  ///< of all robots

  RosDistribution distribution_;
  RecordingFile file_;
  mcap::Writer writer_;
  std::map<std::string, std::uint16_t> schemas_;   ///< by type
  std::map<std::string, std::uint16_t> channels_;  ///< by topic
  std::vector<RobotTopics> topics_;
  std::vector<std::vector<std::uint16_t>> channels_of_robot_;  ///< by robot and topic
  RobotMarkers markers_;
  bool has_poses_ = false;                                 ///< of any robot so far: a real one's are not known
  std::vector<std::optional<mrpt::math::TPose2D>> poses_;  ///< by robot, in this step
  std::uint16_t rawlog_ = 0, clock_ = 0, markers_channel_ = 0;
};

}  // namespace robosim
