#include <map>

#include "bags/bag.h"
#include "mcap/reader.h"

namespace robosim {
namespace {

class McapBag final : public BagFile {
 public:
  explicit McapBag(const std::filesystem::path& file) : reader_(file) {}

  const std::vector<BagTopic>& topics() const override { return topics_; }
  std::optional<BagMessage> next() override {
    const auto message = reader_.next();
    if (!message) {
      fault_ = reader_.fault();
      is_cut_off_ = reader_.isCutOff();
      return std::nullopt;
    }
    return taken(*message);
  }
  std::optional<BagMessage> at(const BagPlace& place) override {
    reader_.seek({place.record, place.within});
    const auto message = reader_.next();
    return message ? std::make_optional(taken(*message)) : std::nullopt;
  }
  std::string fault() const override { return fault_; }
  bool isCutOff() const override { return is_cut_off_; }

 private:
  BagMessage taken(const mcap::Message& message) {
    const auto [known, is_new] = topic_of_.try_emplace(message.channel, topics_.size());
    if (is_new) {
      const mcap::Channel& channel = reader_.channels().at(message.channel);
      const auto schema = reader_.schemas().find(channel.schema_id);
      topics_.push_back(
          {channel.topic, schema == reader_.schemas().end() ? "" : schema->second.name, channel.message_encoding});
    }
    const auto place = reader_.place();
    return {
        known->second, static_cast<std::int64_t>(message.log_time_ns), {place.record, place.in_chunk}, message.data};
  }

  mcap::Reader reader_;
  std::map<std::uint16_t, std::size_t> topic_of_;  ///< by channel
  std::vector<BagTopic> topics_;
  std::string fault_;
  bool is_cut_off_ = false;
};

}  // namespace

std::unique_ptr<BagFile> openMcapBag(const std::filesystem::path& file) { return std::make_unique<McapBag>(file); }

}  // namespace robosim
