#include "recording/bag/bag_index.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/label.h"
#include "base/text_table.h"
#include "recording/bag/bag_names.h"
#include "ros/cdr.h"
#include "topics/topic.h"

namespace robosim {
namespace {

constexpr std::string_view kZstdFrame = "\x28\xb5\x2f\xfd";

/// What was found of a topic.
struct ScannedTopic {
  BagUse use = BagUse::none;
  std::uint64_t messages = 0;
  bool has_stamps = false;  ///< a header has a time other than 0
  std::string frame, child_frame;
  std::optional<ros::CameraInfo> info;
};

/// The part of a topic's name before the last '/', without the first one: "robot1" of "/robot1/tf".
std::string namespaceOf(const std::string& topic) {
  const std::size_t end = topic.rfind('/');
  const std::size_t begin = topic.starts_with('/') ? 1 : 0;
  return end == std::string::npos || end <= begin ? "" : topic.substr(begin, end - begin);
}

std::string lastPartOf(const std::string& name) { return name.substr(name.rfind('/') + 1); }

class Indexing {
 public:
  Indexing(Bag& bag, const std::string& name) : bag_(bag), name_(name) {}

  BagIndex make() {
    scan();
    for (auto& [in, frames] : frames_) frames->sort();
    nameChannels();
    chooseOdometry();
    checkNotEmpty();
    addEntries();
    describeOthers();
    return std::move(index_);
  }

 private:
  /// A message, of a topic of the scan.
  struct Found {
    std::size_t topic = 0;
    std::int64_t stamp_ns = 0, log_ns = 0;
    BagPlace place;
  };

  void scan() {
    constexpr std::uint64_t kMessagesPerCheck = 4096;
    std::uint64_t count = 0;
    while (const auto message = bag_.next()) {
      if (++count % kMessagesPerCheck == 0) throwIfInterrupted(name_ + " was not read to its end");
      while (topics_.size() < bag_.topics().size()) {
        const BagTopic& topic = bag_.topics()[topics_.size()];
        topics_.emplace_back().use = topic.encoding == "cdr" ? bagUseOf(topic.type) : BagUse::none;
      }
      ScannedTopic& topic = topics_[message->topic];
      ++topic.messages;
      try {
        if (topic.use != BagUse::none) add(topic, *message);
      } catch (const ros::CdrError& error) {
        addUndecodable(*message, error.what());
      }
    }
  }

  void addUndecodable(const BagMessage& message, const std::string& why) {
    const std::string_view bytes(reinterpret_cast<const char*>(message.data.data()), message.data.size());
    if (bytes.starts_with(kZstdFrame)) {
      throw ConfigError(name_ + ": its messages are compressed by rosbag2 (zstd), which is not read; convert it by " +
                        "ros2 bag convert to storage_id: mcap without compression");
    }
    if (index_.undecodable++ == 0) index_.first_undecodable = bag_.topics()[message.topic].name + ": " + why;
  }

  void add(ScannedTopic& topic, const BagMessage& message) {
    const BagTopic& known = bag_.topics()[message.topic];
    if (topic.use == BagUse::transforms) return addTransforms(known.name, message);
    if (topic.use == BagUse::camera_info) {
      if (!topic.info) topic.info = ros::decode<ros::CameraInfo>(message.data);
      return;
    }
    BagHeader header = bagHeaderOf(known.type, message.data);
    topic.has_stamps = topic.has_stamps || header.stamp_ns != 0;
    if (topic.frame.empty()) topic.frame = std::move(header.frame);
    if (topic.child_frame.empty()) topic.child_frame = std::move(header.child_frame);
    found_.push_back({message.topic, header.stamp_ns, message.log_time_ns, message.place});
  }

  void addTransforms(const std::string& topic, const BagMessage& message) {
    FrameTree& frames = framesOf(namespaceOf(topic));
    const bool is_static = lastPartOf(topic) == "tf_static";
    for (const auto& transform : ros::decode<ros::TFMessage>(message.data).transforms) {
      const std::int64_t stamp_ns = nanosecondsOf(transform.header.stamp);
      frames.add(transform, stamp_ns == 0 ? message.log_time_ns : stamp_ns, is_static);
    }
  }

  FrameTree& framesOf(const std::string& in) {
    FrameTree*& frames = frames_[in];
    if (!frames) frames = &index_.frames.emplace_back();
    return *frames;
  }

  /// Channels of the topics with observations, in their order.
  void nameChannels() {
    BagNamespaces namespaces;
    for (const auto& [in, frames] : frames_) {
      if (!in.empty()) namespaces.with_transforms.insert(in.substr(0, in.find('/')));
      if (!in.empty()) continue;
      for (const auto& frame : frames->names()) {
        const std::size_t end = frame.find('/');
        if (end == std::string::npos) namespaces.has_shared_frames = true;
        if (end != std::string::npos) namespaces.with_transforms.insert(frame.substr(0, end));
      }
    }
    std::vector<BagTopic> read;
    for (std::size_t i = 0; i < topics_.size(); ++i) {
      if (topics_[i].use != BagUse::observation && topics_[i].use != BagUse::odometry) continue;
      read.push_back(bag_.topics()[i]);
      of_channel_.push_back(i);
    }
    const std::vector<BagName> names = bagNames(read, namespaces);
    for (std::size_t i = 0; i < read.size(); ++i) {
      BagChannel& channel = index_.channels.emplace_back();
      channel.topic = read[i].name;
      channel.messages = topics_[of_channel_[i]].messages;
      channel.sensor.type = read[i].type;
      channel.sensor.label = Label{names[i].robot, names[i].sensor, ""}.text();
      channel.sensor.id = names[i].part;
      channel.is_part = names[i].is_part;
      channel.sensor.camera = cameraOf(read[i].name);
      robots_.insert(names[i].robot);
    }
    if (robots_.empty() && frames_.count("") > 0) robots_.insert("robot");
  }

  /// Parameters of the topic "camera_info" beside a picture's, or above it.
  std::optional<ros::CameraInfo> cameraOf(const std::string& picture) const {
    constexpr int kLevels = 2;  // of "/image_raw/compressed"
    std::string in = picture;
    for (int level = 0; level < kLevels && in.find('/') != std::string::npos; ++level) {
      in.resize(in.rfind('/'));
      for (std::size_t i = 0; i < topics_.size(); ++i) {
        if (topics_[i].info && bag_.topics()[i].name == in + "/camera_info") return topics_[i].info;
      }
    }
    return std::nullopt;
  }

  bool isOdometry(const BagChannel& channel) const {
    return channel.sensor.type == ros::Odometry::kType && Label::parse(channel.sensor.label).sensor != kGroundTruth;
  }

  /// Of each robot one odometry: the topic "odom", else its first Odometry, else its transforms.
  void chooseOdometry() {
    for (const auto& robot : robots_) {
      BagChannel* chosen = nullptr;
      for (auto& channel : index_.channels) {
        if (Label::parse(channel.sensor.label).robot != robot || !isOdometry(channel)) continue;
        const bool is_better = !chosen || (lastPartOf(channel.topic) == "odom" && lastPartOf(chosen->topic) != "odom");
        if (is_better) chosen = &channel;
      }
      const FrameTree* const frames = framesOfRobot(robot);
      const std::string base = baseOf(robot, *frames, chosen ? childOf(*chosen) : "");
      const std::string label = Label{robot, "odometry", ""}.text();
      for (auto& channel : index_.channels) {
        if (Label::parse(channel.sensor.label).robot != robot) continue;
        channel.frames = frames;
        channel.base = base;
        if (!isOdometry(channel)) continue;
        if (&channel == chosen) {
          channel.sensor.label = label;
        } else {
          index_.unread.push_back(topicText(channel.topic, channel.sensor.type, channel.messages) +
                                  ": the robot's odometry is " + chosen->topic);
          channel.messages = 0;
        }
      }
      if (!chosen) addOdometryOfTransforms(label, base, *frames);
    }
  }

  std::string childOf(const BagChannel& channel) const {
    return topics_[of_channel_[static_cast<std::size_t>(&channel - index_.channels.data())]].child_frame;
  }

  const FrameTree* framesOfRobot(const std::string& robot) {
    const auto own = frames_.find(robot);
    return own != frames_.end() && !own->second->isEmpty() ? own->second : &framesOf("");
  }

  /// The robot's frame; empty if it is not known.
  static std::string baseOf(const std::string& robot, const FrameTree& frames, const std::string& of_odometry) {
    for (const auto& frame : {of_odometry, robot + "/base_link", robot + "/base_footprint", std::string("base_link"),
                              std::string("base_footprint")}) {
      if (!frame.empty() && frames.contains(frame)) return frame;
    }
    return of_odometry;
  }

  void addOdometryOfTransforms(const std::string& label, const std::string& base, const FrameTree& frames) {
    constexpr int kHighest = 64;  // more is a cycle
    std::string frame = base;
    for (int height = 0; height < kHighest && !frame.empty(); ++height) {
      const std::string& parent = frames.parentOf(frame);
      if (lastPartOf(parent) == "odom") {
        BagChannel channel;
        channel.sensor.label = label;
        channel.odometry_frame = frame;
        channel.frames = &frames;
        channel.messages = frames.posesOf(frame).size();
        of_channel_.push_back(topics_.size());
        index_.channels.push_back(std::move(channel));
        return;
      }
      frame = parent;
    }
  }

  void checkNotEmpty() const {
    std::uint64_t read = 0, messages = 0;
    for (const auto& channel : index_.channels) read += channel.messages;
    if (read > 0) return;
    std::set<std::string> encodings;
    std::string topics;
    constexpr std::size_t kMaxText = 600;
    for (std::size_t i = 0; i < topics_.size(); ++i) {
      const BagTopic& topic = bag_.topics()[i];
      messages += topics_[i].messages;
      if (topic.encoding != "cdr") encodings.insert(topic.encoding);
      if (topics.size() > kMaxText) continue;
      topics += (topics.empty() ? "" : "; ") + topicText(topic.name, topic.type, topics_[i].messages);
    }
    if (messages == 0) {
      throw ConfigError(
          name_ + ": contains no message" +
          (bag_.fault().empty() ? "; it is an empty recording of ROS 2" : " that can be read: " + bag_.fault()));
    }
    if (encodings.count("ros1") > 0) {
      throw ConfigError(name_ +
                        ": has messages of ROS 1, which are not read; convert the bag of ROS 1 by "
                        "rosbags-convert (pip install rosbags), or by MRPT's rosbag2rawlog");
    }
    if (!encodings.empty()) {
      throw ConfigError(name_ + ": has messages in the encoding " + listed({encodings.begin(), encodings.end()}) +
                        "; read are those of ROS 2, in cdr");
    }
    std::string types;
    for (const auto& row : bagUses()) {
      types += (types.empty() ? "" : ", ") + lastPartOf(row.type);
    }
    throw ConfigError(name_ + ": has no topic that is read, but " + topics + "; read are messages of the types " +
                      types);
  }

  void addEntries() {
    // Ground truth and odometry first, so that they are known when other sensors of the same time are read.
    const auto rank = [this](const BagChannel& channel) {
      if (!channel.odometry_frame.empty()) return 1;
      return channel.sensor.type != ros::Odometry::kType ? 2 : isOdometry(channel) ? 1 : 0;
    };
    std::vector<std::size_t> order(index_.channels.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const BagChannel& x = index_.channels[a];
      const BagChannel& y = index_.channels[b];
      return std::tuple(rank(x), x.sensor.label, x.sensor.id) < std::tuple(rank(y), y.sensor.label, y.sensor.id);
    });
    std::vector<BagChannel> channels;
    constexpr auto kNone = static_cast<std::uint32_t>(-1);
    std::vector<std::uint32_t> channel_of(topics_.size() + index_.channels.size(), kNone);  // by topic
    std::vector<std::size_t> topic_of;
    for (const std::size_t old : order) {
      if (index_.channels[old].messages > 0) channel_of[of_channel_[old]] = static_cast<std::uint32_t>(channels.size());
      topic_of.push_back(of_channel_[old]);
      channels.push_back(std::move(index_.channels[old]));
    }
    index_.channels = std::move(channels);
    of_channel_ = std::move(topic_of);
    index_.entries.reserve(found_.size());
    for (const Found& found : found_) {
      if (channel_of[found.topic] == kNone) continue;
      const std::int64_t time_ns = topics_[found.topic].has_stamps ? found.stamp_ns : found.log_ns;
      index_.entries.push_back({time_ns, found.place, channel_of[found.topic]});
    }
    found_ = {};
    for (std::uint32_t i = 0; i < index_.channels.size(); ++i) {
      const BagChannel& channel = index_.channels[i];
      if (channel.odometry_frame.empty()) continue;
      const auto& poses = channel.frames->posesOf(channel.odometry_frame);
      for (std::size_t k = 0; k < poses.size(); ++k) index_.entries.push_back({poses[k].time_ns, {k, 0}, i});
    }
    std::stable_sort(index_.entries.begin(), index_.entries.end(), [](const BagEntry& a, const BagEntry& b) {
      return std::pair(a.time_ns, a.channel) < std::pair(b.time_ns, b.channel);
    });
  }

  void describeOthers() {
    for (std::size_t i = 0; i < topics_.size(); ++i) {
      if (topics_[i].use != BagUse::none) continue;
      const BagTopic& topic = bag_.topics()[i];
      index_.unread.push_back(topicText(topic.name, topic.type, topics_[i].messages) +
                              (topic.encoding == "cdr" ? "" : ": their encoding is " + topic.encoding));
    }
    std::sort(index_.unread.begin(), index_.unread.end());
    for (std::size_t i = 0; i < index_.channels.size(); ++i) {
      const BagChannel& channel = index_.channels[i];
      const bool has_pose =
          channel.sensor.type != ros::Odometry::kType && channel.sensor.type != ros::BatteryState::kType;
      if (!channel.odometry_frame.empty() || !has_pose || channel.messages == 0) continue;
      const std::string& frame = topics_[of_channel_[i]].frame;
      if (!frame.empty() && (frame == channel.base || channel.frames->find(channel.base, frame, 0))) continue;
      index_.assumptions.push_back(channel.topic + ": no transform from " +
                                   (channel.base.empty() ? "base_link" : channel.base) +
                                   (frame.empty() ? ", because it has no frame" : " to " + frame) +
                                   "; its pose on the robot is taken as the origin");
    }
  }

  Bag& bag_;
  const std::string& name_;
  BagIndex index_;
  std::vector<ScannedTopic> topics_;  ///< as Bag::topics()
  std::vector<Found> found_;
  std::map<std::string, FrameTree*> frames_;  ///< by the namespace of their topics
  std::vector<std::size_t> of_channel_;       ///< topic of each channel
  std::set<std::string> robots_;
};

}  // namespace

std::string topicText(const std::string& name, const std::string& type, std::uint64_t messages) {
  return name + " (" + (type.empty() ? "no type" : type) + "), " + withCommas(messages) +
         (messages == 1 ? " message" : " messages");
}

BagIndex indexOf(Bag& bag, const std::string& name) { return Indexing(bag, name).make(); }

}  // namespace robosim
