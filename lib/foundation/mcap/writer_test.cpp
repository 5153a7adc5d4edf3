#include "mcap/writer.h"

#include <gtest/gtest.h>

#include "mcap/reader.h"
#include "mcap/testing/sample_file.h"

namespace robosim::mcap {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::vector<ReadMessage> messagesIn(const Bytes& bytes) {
  const FileOf file(bytes);
  Reader reader(file.path());
  return readAll(reader);
}

TEST(McapWriter, WritesMessagesThatTheReaderReadsInTheirOrder) {
  const SampleFile sample(3);
  const FileOf file(sample.bytes);
  Reader reader(file.path());
  EXPECT_EQ(reader.header().profile, "ros2");
  EXPECT_EQ(reader.header().library, "test");
  EXPECT_EQ(readAll(reader), sample.messages);
  EXPECT_EQ(reader.fault(), "");
  EXPECT_EQ(reader.schemas().at(1).name, "std_msgs/msg/String");
  EXPECT_EQ(reader.channels().at(0).topic, "/a");
  EXPECT_EQ(reader.channels().at(1).schema_id, 0);
}

TEST(McapWriter, WritesTheSummary) {
  const SampleFile sample(3);
  const FileOf file(sample.bytes);
  Reader reader(file.path());
  const Contents& contents = reader.contents();
  ASSERT_TRUE(contents.has_summary);
  ASSERT_TRUE(contents.statistics);
  EXPECT_EQ(contents.statistics->messages, sample.messages.size());
  EXPECT_EQ(contents.statistics->chunks, 3u);
  EXPECT_EQ(contents.statistics->channels, 2u);
  EXPECT_EQ(contents.statistics->schemas, 1u);
  EXPECT_EQ(contents.statistics->start_time, sample.messages.front().time_ns);
  EXPECT_EQ(contents.statistics->end_time, sample.messages.back().time_ns);
  EXPECT_EQ(contents.statistics->messages_by_channel.at(0) + contents.statistics->messages_by_channel.at(1),
            sample.messages.size());
  ASSERT_EQ(contents.chunks.size(), 3u);
  for (const auto& chunk : contents.chunks) {
    EXPECT_EQ(chunk.compression, "zstd");
    EXPECT_EQ(sample.bytes[chunk.chunk_start], static_cast<std::uint8_t>(Opcode::chunk));
    for (const auto& [channel, offset] : chunk.message_index_offsets) {
      ASSERT_EQ(sample.bytes[offset], static_cast<std::uint8_t>(Opcode::message_index));
      EXPECT_EQ(sample.bytes[offset + kRecordPrefixBytes], channel);
    }
    EXPECT_EQ(chunk.message_index_offsets.begin()->second, chunk.chunk_start + chunk.chunk_length);
  }
  EXPECT_EQ(readAll(reader), sample.messages) << "after contents()";
}

TEST(McapWriter, WritesAttachmentsAndMetadata) {
  const SampleFile sample(2);
  const FileOf file(sample.bytes);
  Reader reader(file.path());
  const Contents& contents = reader.contents();
  ASSERT_EQ(contents.attachments.size(), 1u);
  EXPECT_EQ(reader.attachment(contents.attachments[0]), sample.attachment);
  ASSERT_EQ(contents.metadata.size(), 1u);
  EXPECT_EQ(reader.metadata(contents.metadata[0]), sample.metadata);
}

TEST(McapWriter, WritesAnEmptyFile) {
  Bytes bytes;
  Writer writer([&](auto part) { bytes.insert(bytes.end(), part.begin(), part.end()); }, {"", "test"});
  writer.finish();
  EXPECT_TRUE(messagesIn(bytes).empty());
  const FileOf file(bytes);
  Reader reader(file.path());
  EXPECT_TRUE(reader.contents().has_summary);
  EXPECT_EQ(reader.contents().statistics->messages, 0u);
}

}  // namespace
}  // namespace robosim::mcap
