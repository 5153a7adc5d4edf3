#include "mcap/reader.h"

#include <algorithm>
#include <iterator>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "mcap/testing/sample_file.h"

namespace robosim::mcap {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::vector<ReadMessage> since(const std::vector<ReadMessage>& messages, std::uint64_t time_ns) {
  std::vector<ReadMessage> later;
  std::copy_if(messages.begin(), messages.end(), std::back_inserter(later),
               [&](const ReadMessage& message) { return message.time_ns >= time_ns; });
  return later;
}

std::string faultOf(const Bytes& bytes) {
  const FileOf file(bytes);
  Reader reader(file.path());
  readAll(reader);
  return reader.fault();
}

std::string errorOf(const Bytes& bytes) {
  const FileOf file(bytes);
  try {
    Reader reader(file.path());
  } catch (const ConfigError& error) {
    const std::string what = error.what();
    return what.substr(what.find(".mcap: ") + 7);
  }
  return "";
}

std::size_t lastChunkOf(const SampleFile& sample) {
  const FileOf file(sample.bytes);
  return Reader(file.path()).contents().chunks.back().chunk_start;
}

TEST(McapReader, ReadsFilesWithAndWithoutChunksAndSummary) {
  const SampleFile sample(2);
  for (const char* compression : {"none", "", "lz4", "zstd"}) {
    const FileOf file(withoutSummary(sample, compression));
    Reader reader(file.path());
    EXPECT_EQ(readAll(reader), sample.messages) << compression;
    EXPECT_EQ(reader.fault(), "") << compression;
    EXPECT_FALSE(reader.contents().has_summary);
    ASSERT_EQ(reader.contents().metadata.size(), 1u) << compression;
    EXPECT_EQ(reader.metadata(reader.contents().metadata[0]), sample.metadata);
  }
}

TEST(McapReader, ReadsAFileThatIsCutAnywhereUpToTheLastWholeChunk) {
  const SampleFile sample(4);
  std::vector<std::size_t> chunk_ends;
  {
    const FileOf file(sample.bytes);
    Reader reader(file.path());
    for (const auto& chunk : reader.contents().chunks) chunk_ends.push_back(chunk.chunk_start + chunk.chunk_length);
  }
  ASSERT_EQ(chunk_ends.size(), 4u);
  for (std::size_t size = kMagic.size(); size < sample.bytes.size(); size += 37) {
    const FileOf file(std::span(sample.bytes).first(size));
    Reader reader(file.path());
    const auto whole = static_cast<std::size_t>(
        std::count_if(chunk_ends.begin(), chunk_ends.end(), [&](std::size_t end) { return end <= size; }));
    const std::vector<ReadMessage> expected(sample.messages.begin(),
                                            sample.messages.begin() + static_cast<std::ptrdiff_t>(20 * whole));
    ASSERT_EQ(readAll(reader), expected) << size;
    if (!reader.fault().empty()) {
      ASSERT_EQ(reader.fault(), "it is cut off") << size;
      ASSERT_TRUE(reader.isCutOff());
    }
    ASSERT_EQ(reader.contents().chunks.size(), whole) << size;
    ASSERT_FALSE(reader.contents().has_summary) << size;
  }
}

TEST(McapReader, ContinuesAtAnyMessageThatWasRead) {
  const SampleFile sample(3);
  for (const Bytes& bytes : {sample.bytes, withoutSummary(sample, "none"), withoutSummary(sample, "lz4")}) {
    const FileOf file(bytes);
    Reader reader(file.path());
    std::vector<Reader::Place> places;
    while (reader.next()) places.push_back(reader.place());
    ASSERT_EQ(places.size(), sample.messages.size());
    for (const std::size_t i : {59u, 0u, 20u, 21u, 19u, 40u, 39u, 1u}) {
      reader.seek(places[i]);
      EXPECT_EQ(readAll(reader), since(sample.messages, sample.messages[i].time_ns)) << i;
      EXPECT_EQ(reader.fault(), "");
    }
  }
}

TEST(McapReader, ContinuesAtATime) {
  const SampleFile sample(3);
  for (const Bytes& bytes : {sample.bytes, withoutSummary(sample, "none"), withoutSummary(sample, "zstd")}) {
    const FileOf file(bytes);
    Reader reader(file.path());
    for (const std::uint64_t time_ns : {1'590u, 0u, 1'200u, 1'195u, 5'000u}) {
      reader.seekTime(time_ns);
      EXPECT_EQ(readAll(reader), since(sample.messages, time_ns)) << time_ns;
    }
  }
}

TEST(McapReader, ReadsAFileWithADamagedSummaryWithoutIt) {
  const SampleFile sample(3);
  Bytes bytes = sample.bytes;
  bytes[bytes.size() - 60] ^= 1;
  const FileOf file(bytes);
  Reader reader(file.path());
  EXPECT_FALSE(reader.contents().has_summary);
  EXPECT_EQ(reader.contents().chunks.size(), 3u);
  EXPECT_EQ(reader.contents().attachments.size(), 1u);
  EXPECT_EQ(reader.attachment(reader.contents().attachments[0]), sample.attachment);
  EXPECT_EQ(readAll(reader), sample.messages);
}

TEST(McapReader, RefusesFilesOfOtherKinds) {
  EXPECT_EQ(errorOf({}), "is no MCAP file, which begins with the bytes 89 4D 43 41 50 30 0D 0A");
  EXPECT_EQ(errorOf({'<', 'w', 'o', 'r', 'l', 'd', '/', '>'}),
            "is no MCAP file, which begins with the bytes 89 4D 43 41 50 30 0D 0A");
  EXPECT_EQ(errorOf({0x89, 'M', 'C', 'A', 'P', '1', '\r', '\n'}),
            "is an MCAP file of version \"1\"; version 0 can be read");
}

TEST(McapReader, ReportsDamageAndItsPlace) {
  const SampleFile sample(2);
  const std::size_t chunk = lastChunkOf(sample);
  Bytes bytes = sample.bytes;
  bytes[chunk + kRecordPrefixBytes + 24] ^= 1;  // its checksum
  EXPECT_EQ(faultOf(bytes), "a chunk does not match its checksum (the record at byte " + std::to_string(chunk) + ")");
  bytes = sample.bytes;
  bytes[chunk + kRecordPrefixBytes + 32] = 'x';  // its compression
  EXPECT_EQ(faultOf(bytes), "a chunk is compressed by \"xstd\"; zstd, lz4 and none can be read (the record at byte " +
                                std::to_string(chunk) + ")");
  bytes = sample.bytes;
  bytes[chunk + kRecordPrefixBytes + 23] = 1;  // its size
  EXPECT_NE(faultOf(bytes).find("; at most 268435456 are read (the record at byte "), std::string::npos)
      << faultOf(bytes);
  bytes.assign(sample.bytes.begin(), sample.bytes.begin() + 8);
  bytes.insert(bytes.end(), {15, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(faultOf(bytes), "the first record is no header");
}

TEST(McapReader, RefusesMessagesOfUnknownChannels) {
  Bytes bytes(kMagic.begin(), kMagic.end());
  append(bytes, Header{});
  RecordWriter writer(bytes);
  const std::size_t begin = writer.begin(Opcode::message);
  writer.u16(3);
  writer.u32(0);
  writer.u64(0);
  writer.u64(0);
  writer.end(begin);
  EXPECT_EQ(faultOf(bytes), "a message has the channel 3, which is not in the file before it (the record at byte 25)");
}

TEST(McapReader, IgnoresUnknownRecordsAndUnknownFields) {
  const SampleFile sample(1);
  Bytes bytes = withoutSummary(sample, "none");
  const Bytes record{0x81, 3, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3};
  const std::size_t after_header = kMagic.size() + kRecordPrefixBytes + 8 + 8;
  bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(after_header), record.begin(), record.end());
  // The header becomes longer by two bytes.
  bytes[kMagic.size() + 1] += 2;
  bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(after_header), {0, 0});
  const FileOf file(bytes);
  Reader reader(file.path());
  EXPECT_EQ(readAll(reader), sample.messages);
  EXPECT_EQ(reader.fault(), "");
}

}  // namespace
}  // namespace robosim::mcap
