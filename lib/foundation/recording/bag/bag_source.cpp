#include <map>
#include <stdexcept>

#include "bags/bag.h"
#include "base/error_list.h"
#include "base/file_kind.h"
#include "base/interrupt.h"
#include "mcap/reader.h"
#include "recording/bag/bag_index.h"
#include "recording/bag/bag_picture.h"
#include "recording/mcap_recording.h"
#include "recording/observation_source.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;

/// The messages of a recording of ROS 2 as observations, in the order of time.
class BagSource final : public ObservationSource {
 public:
  explicit BagSource(const std::filesystem::path& bag) : name_(bag.string()), bag_(bag) {}

  CObservation::Ptr next() override {
    if (!index_) open();
    while (at_ < index_->entries.size()) {
      position_ = at_;
      if (auto observation = readEntry()) return observation;
    }
    describeUnknownFormats();
    return {};
  }
  std::uint64_t position() const override { return position_; }
  void seek(std::uint64_t position) override { at_ = static_cast<std::size_t>(position); }
  const ReadReport& report() const override { return report_; }

 private:
  void open() {
    index_ = indexOf(bag_, name_);
    report_.unread = index_->unread;
    report_.assumptions = index_->assumptions;
    report_.ends_early = !bag_.fault().empty();
    report_.is_damaged = bag_.isDamaged();
    undecodable_ = index_->undecodable;
    first_undecodable_ = index_->first_undecodable;
    describeDamage();
  }

  void describeDamage() {
    std::string text = bag_.fault().empty() ? "" : "ends early: " + bag_.fault();
    if (undecodable_ > 0) {
      report_.is_damaged = true;
      text += (text.empty() ? "" : "; ") +
              (undecodable_ == 1 ? std::string("a message is damaged and left out, of ")
                                 : std::to_string(undecodable_) + " messages are damaged and left out, the first of ") +
              first_undecodable_;
    }
    if (!text.empty()) report_.error = name_ + ": " + text;
  }

  /// The observation of the next entry and of those that belong to it; null for one that has none.
  CObservation::Ptr readEntry() {
    const BagEntry& first = index_->entries[at_];
    const BagChannel& channel = index_->channels[first.channel];
    CObservation::Ptr observation = observationOf(index_->entries[at_++]);
    for (std::uint32_t before = first.channel; channel.is_part && at_ < index_->entries.size(); ++at_) {
      const BagEntry& entry = index_->entries[at_];
      const BagChannel& other = index_->channels[entry.channel];
      if (entry.time_ns != first.time_ns || entry.channel <= before || !other.is_part) break;
      if (other.sensor.label != channel.sensor.label) break;
      before = entry.channel;
      const CObservation::Ptr part = observationOf(entry);
      if (!observation) {
        observation = part;
      } else if (part && !addBagRange(*observation, *part)) {
        break;  // a sensor with another maximum, which is the next observation
      }
    }
    return observation;
  }

  CObservation::Ptr observationOf(const BagEntry& entry) {
    const BagChannel& channel = index_->channels[entry.channel];
    ++report_.entries;
    CObservation::Ptr made;
    if (!channel.odometry_frame.empty()) {
      const auto& poses = channel.frames->posesOf(channel.odometry_frame);
      made = bagOdometry(channel.sensor.label, poses[static_cast<std::size_t>(entry.place.record)].transform);
    } else {
      const auto message = bag_.at(entry.place);
      made = message ? decoded(channel, entry, message->data) : nullptr;
      if (!message) addDamage(channel, "it cannot be read any more");
    }
    if (made) made->timestamp = timestampOf(entry.time_ns);
    return made;
  }

  CObservation::Ptr decoded(const BagChannel& channel, const BagEntry& entry, std::span<const std::uint8_t> data) {
    try {
      BagSensor sensor = channel.sensor;
      const BagHeader header = bagHeaderOf(sensor.type, data);
      if (header.frame != channel.base) {
        const auto pose = channel.frames->find(channel.base, header.frame, entry.time_ns);
        if (pose) sensor.robot_from_frame = *pose;
      }
      return bagObservation(sensor, data);
    } catch (const UnknownPictureFormat& error) {
      Unknown& unknown = unknown_[entry.channel];
      if (unknown.messages++ == 0) unknown.why = error.what();
    } catch (const std::exception& error) {
      addDamage(channel, error.what());
    }
    return nullptr;
  }

  void addDamage(const BagChannel& channel, const std::string& why) {
    if (undecodable_++ == 0) first_undecodable_ = channel.topic + ": " + why;
    describeDamage();
  }

  void describeUnknownFormats() {
    report_.unread = index_->unread;
    for (const auto& [channel, unknown] : unknown_) {
      const BagChannel& of = index_->channels[channel];
      report_.unread.push_back(topicText(of.topic, of.sensor.type, unknown.messages) + ": " + unknown.why);
    }
  }

  struct Unknown {
    std::uint64_t messages = 0;
    std::string why;
  };

  std::string name_;
  Bag bag_;
  std::optional<BagIndex> index_;  ///< when next() has been called
  std::size_t at_ = 0, position_ = 0;
  std::uint64_t undecodable_ = 0;
  std::string first_undecodable_;
  std::map<std::uint32_t, Unknown> unknown_;  ///< pictures of formats that are not read, by channel
  ReadReport report_;
};

/// Whether an MCAP file has the topic with a rawlog.
bool containsRawlog(const std::filesystem::path& file) {
  const auto has_topic = [](mcap::Reader& reader) {
    for (const auto& [id, channel] : reader.channels()) {
      if (channel.topic == kRawlogTopic) return true;
    }
    return false;
  };
  // RoboSim's files begin with a few messages of the world, then the rawlog. The summary of a large file takes seconds.
  constexpr int kFirst = 16;
  mcap::Reader first(file);
  for (int i = 0; i < kFirst && first.next(); ++i) {
    if (has_topic(first)) return true;
  }
  mcap::Reader reader(file);
  // A summary may be without channels.
  if (reader.contents().has_summary && !reader.channels().empty()) return has_topic(reader);
  while (!has_topic(reader) && reader.next()) {
  }
  return has_topic(reader);
}

}  // namespace

std::unique_ptr<ObservationSource> openRosRecording(const std::filesystem::path& bag) {
  return std::make_unique<BagSource>(bag);
}

bool isRosRecording(const std::filesystem::path& recording) {
  std::error_code none;
  if (std::filesystem::is_directory(recording, none)) return true;
  const FileKind kind = kindOfFile(recording);
  return kind == FileKind::sqlite || (kind == FileKind::mcap && !containsRawlog(recording));
}

}  // namespace robosim
