#include <algorithm>
#include <filesystem>
#include <iostream>

#include <nlohmann/json.hpp>

#include "base/error_list.h"
#include "base/file_kind.h"
#include "base/text_table.h"
#include "mcap/reader.h"
#include "replay/replay.h"
#include "run/json_text.h"

namespace robosim {
namespace {

struct TopicCount {
  std::string topic, type;
  std::uint64_t messages = 0;
};

/// What the index of a file says, and its metadata.
struct McapIndex {
  mcap::Header header;
  mcap::Statistics statistics;
  std::vector<TopicCount> topics;  ///< by name
  std::vector<mcap::Metadata> metadata;
  std::vector<mcap::AttachmentIndex> attachments;
  std::uint64_t packed_bytes = 0, unpacked_bytes = 0;  ///< of all chunks

  /// Between the first message and the last [s].
  double duration() const { return 1e-9 * static_cast<double>(statistics.end_time - statistics.start_time); }
  /// Mean rate [Hz].
  double rate(const TopicCount& topic) const {
    return topic.messages > 1 && duration() > 0 ? static_cast<double>(topic.messages - 1) / duration() : 0;
  }
  /// A value of the metadata; empty for none.
  std::string value(const std::string& record, const std::string& key) const {
    const auto found = std::find_if(metadata.begin(), metadata.end(), [&](const auto& m) { return m.name == record; });
    if (found == metadata.end()) return "";
    const auto value = found->values.find(key);
    return value == found->values.end() ? "" : value->second;
  }
};

/// @throws ConfigError for a file without an index
McapIndex readIndex(const std::string& file) {
  if (!std::filesystem::is_regular_file(file) || !isMcapName(file)) {
    throw ConfigError(file + ": --index reads the index of an .mcap file; omit it to read the whole recording");
  }
  mcap::Reader reader(file);
  const mcap::Contents& contents = reader.contents();
  if (!contents.statistics) {
    throw ConfigError(file +
                      ": has no index with statistics, as a file that is cut off; omit --index to read the whole "
                      "recording");
  }
  McapIndex index;
  index.header = reader.header();
  index.statistics = *contents.statistics;
  index.attachments = contents.attachments;
  for (const auto& [id, channel] : reader.channels()) {
    const auto schema = reader.schemas().find(channel.schema_id);
    const auto count = index.statistics.messages_by_channel.find(id);
    index.topics.push_back({channel.topic, schema == reader.schemas().end() ? "" : schema->second.name,
                            count == index.statistics.messages_by_channel.end() ? 0 : count->second});
  }
  std::sort(index.topics.begin(), index.topics.end(), [](const auto& a, const auto& b) { return a.topic < b.topic; });
  for (const auto& chunk : contents.chunks) {
    index.packed_bytes += chunk.compressed_size;
    index.unpacked_bytes += chunk.uncompressed_size;
  }
  try {
    for (const auto& place : contents.metadata) index.metadata.push_back(reader.metadata(place));
  } catch (const mcap::RecordError& error) {
    throw ConfigError(file + ": " + error.what() + "; omit --index to read what can be read");
  }
  return index;
}

nlohmann::ordered_json asJson(const McapIndex& index, const std::string& file) {
  nlohmann::ordered_json json{{"mcap", file},
                              {"profile", index.header.profile},
                              {"library", index.header.library},
                              {"messages", index.statistics.messages},
                              {"start_s", 1e-9 * static_cast<double>(index.statistics.start_time)},
                              {"duration_s", index.duration()},
                              {"chunks", index.statistics.chunks},
                              {"packed_bytes", index.packed_bytes},
                              {"unpacked_bytes", index.unpacked_bytes}};
  for (const auto& topic : index.topics) {
    json["topics"].push_back(
        {{"topic", topic.topic}, {"type", topic.type}, {"count", topic.messages}, {"rate_hz", index.rate(topic)}});
  }
  for (const auto& record : index.metadata) json["metadata"][record.name] = record.values;
  for (const auto& attachment : index.attachments) {
    json["attachments"].push_back({{"name", attachment.name}, {"bytes", attachment.data_size}});
  }
  return json;
}

std::string megabytes(std::uint64_t bytes) { return fixed(1e-6 * static_cast<double>(bytes), 1) + " MB"; }

void print(const McapIndex& index, const std::string& file) {
  Rows head{{"mcap", file + ": " + withCommas(index.statistics.messages) + " messages over " +
                         fixed(index.duration(), 1) + " s"}};
  if (const std::string world = index.value("robosim", "world"); !world.empty()) {
    head.push_back({"run", world + ", seed " + index.value("robosim", "seed") + ", steps of " +
                               index.value("robosim", "period_s") + " s"});
  }
  if (const std::string end = index.value("robosim_outcome", "ended_by"); !end.empty()) {
    const std::string winner = index.value("robosim_outcome", "won_by");
    head.push_back({"ended", end + (winner.empty() || winner == "null" ? "" : ", " + winner + " has won") +
                                 ", digest " + index.value("robosim_outcome", "digest")});
  }
  for (const auto& attachment : index.attachments) {
    head.push_back({"file", attachment.name + ", " + withCommas(attachment.data_size) + " bytes"});
  }
  head.push_back({"chunks", withCommas(index.statistics.chunks) + ", " + megabytes(index.packed_bytes) + " of " +
                                megabytes(index.unpacked_bytes)});
  std::cout << listing(head) << '\n';
  Rows rows{{"topic", "type", "messages", "per s"}};
  for (const auto& topic : index.topics) {
    rows.push_back({topic.topic, topic.type, withCommas(topic.messages), fixed(index.rate(topic), 2)});
  }
  std::cout << table(rows);
}

}  // namespace

ReplayResult printIndex(const ReplayArguments& arguments) {
  const McapIndex index = readIndex(arguments.rawlog);
  if (arguments.json) {
    std::cout << jsonText(asJson(index, arguments.rawlog)) << '\n';
  } else {
    print(index, arguments.rawlog);
  }
  return ReplayResult::complete;
}

}  // namespace robosim
