#pragma once
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "bags/bag.h"
#include "recording/bag/bag_observations.h"
#include "topics/frame_tree.h"

namespace robosim {

/// A topic that is read, or the odometry that a robot's transforms are.
struct BagChannel {
  std::string topic;  ///< "/robot1/scan"
  std::uint64_t messages = 0;
  BagSensor sensor;                   ///< without the pose
  bool is_part = false;               ///< of an observation with all channels of the label and time
  const FrameTree* frames = nullptr;  ///< of the robot
  std::string base;                   ///< the robot's frame
  std::string odometry_frame;         ///< the frame whose poses are the odometry; empty for a topic
};

/// A message to read.
struct BagEntry {
  std::int64_t time_ns = 0;   ///< since 1970: of the header, or of recording in a topic without times
  BagPlace place;             ///< for odometry of transforms, the record is the index of the pose
  std::uint32_t channel = 0;  ///< in BagIndex::channels
};

/// What a recording contains, in the order in which it is read.
struct BagIndex {
  std::deque<FrameTree> frames;  ///< of each namespace
  std::vector<BagChannel> channels;
  std::vector<BagEntry> entries;                 ///< by time, then channel, then the order of the recording
  std::vector<std::string> unread, assumptions;  ///< as ReadReport has them
  std::uint64_t undecodable = 0;                 ///< number of messages that are not of their type
  std::string first_undecodable;                 ///< "topic: why"
};

/// Reads all messages once. @throws ConfigError when none is read; Interrupted
BagIndex indexOf(Bag& bag, const std::string& name);

/// "/points (sensor_msgs/msg/PointCloud2), 12 messages"
std::string topicText(const std::string& name, const std::string& type, std::uint64_t messages);

}  // namespace robosim
