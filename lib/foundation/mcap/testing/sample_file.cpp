#include "mcap/testing/sample_file.h"

#include <fstream>
#include <stdexcept>

#include <lz4frame.h>

#include "mcap/compression.h"
#include "mcap/writer.h"

namespace robosim::mcap {
namespace {

constexpr std::size_t kMessagesPerChunk = 20;
constexpr std::size_t kDataBytes = 200;
const Schema kSchema{1, "std_msgs/msg/String", "ros2msg", "string data\n"};

Channel channelOf(std::uint16_t id) {
  return {id, id == 0 ? std::uint16_t{1} : std::uint16_t{0}, id == 0 ? "/a" : "/b", "cdr", {}};
}

std::vector<std::uint8_t> packed(const std::vector<std::uint8_t>& records, const std::string& compression) {
  std::vector<std::uint8_t> out;
  if (compression.empty()) return records;
  if (compression == "zstd") {
    ZstdPacker().pack(records, out);
    return out;
  }
  out.resize(LZ4F_compressFrameBound(records.size(), nullptr));
  out.resize(LZ4F_compressFrame(out.data(), out.size(), records.data(), records.size(), nullptr));
  return out;
}

}  // namespace

std::vector<ReadMessage> readAll(Reader& reader) {
  std::vector<ReadMessage> all;
  while (const auto message = reader.next()) {
    all.push_back({reader.channels().at(message->channel).topic,
                   message->log_time_ns,
                   message->sequence,
                   {message->data.begin(), message->data.end()}});
  }
  return all;
}

FileOf::FileOf(std::span<const std::uint8_t> bytes) {
  std::ofstream out(path(), std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!out.flush()) throw std::runtime_error("a file of a test cannot be written");
}

SampleFile::SampleFile(std::size_t chunks) {
  // A chunk is written when it is full, so that its last message has all of the remaining bytes.
  constexpr std::size_t kChunk = kMessagesPerChunk * (kDataBytes + 31);
  Writer writer([&](auto part) { bytes.insert(bytes.end(), part.begin(), part.end()); }, {"ros2", "test"}, kChunk);
  Schema schema = kSchema;
  writer.addSchema(schema);
  writer.addChannel(channelOf(0));
  writer.addChannel(channelOf(1));
  writer.addMetadata(metadata);
  for (std::size_t i = 0; i < kMessagesPerChunk * chunks; ++i) {
    ReadMessage message{i % 2 == 0 ? "/a" : "/b", 1'000 + 10 * i, static_cast<std::uint32_t>(i / 2), {}};
    message.data.resize(kDataBytes);
    for (std::size_t byte = 0; byte < kDataBytes; ++byte) message.data[byte] = static_cast<std::uint8_t>(i * byte / 7);
    writer.write(static_cast<std::uint16_t>(i % 2), message.time_ns, message.data);
    messages.push_back(message);
    if (i == kMessagesPerChunk) writer.attach(attachment);
  }
  writer.finish();
}

std::vector<std::uint8_t> withoutSummary(const SampleFile& sample, const std::string& compression) {
  std::vector<std::uint8_t> file(kMagic.begin(), kMagic.end());
  append(file, Header{"ros2", "test"});
  std::vector<std::uint8_t> records;
  append(records, kSchema);
  append(records, channelOf(0));
  append(records, channelOf(1));
  RecordWriter record(records);
  for (const auto& message : sample.messages) {
    const std::size_t begin = record.begin(Opcode::message);
    record.u16(message.topic == "/a" ? 0 : 1);
    record.u32(message.sequence);
    record.u64(message.time_ns);
    record.u64(message.time_ns);
    records.insert(records.end(), message.data.begin(), message.data.end());
    record.end(begin);
  }
  RecordWriter writer(file);
  if (compression == "none") {
    file.insert(file.end(), records.begin(), records.end());
  } else {
    const auto bytes = packed(records, compression);
    const std::size_t begin = writer.begin(Opcode::chunk);
    writer.u64(sample.messages.front().time_ns);
    writer.u64(sample.messages.back().time_ns);
    writer.u64(records.size());
    writer.u32(0);
    writer.text(compression);
    writer.u64(bytes.size());
    file.insert(file.end(), bytes.begin(), bytes.end());
    writer.end(begin);
  }
  append(file, sample.metadata);
  const std::size_t data_end = writer.begin(Opcode::data_end);
  writer.u32(0);
  writer.end(data_end);
  const std::size_t footer = writer.begin(Opcode::footer);
  writer.u64(0);
  writer.u64(0);
  writer.u32(0);
  writer.end(footer);
  file.insert(file.end(), kMagic.begin(), kMagic.end());
  return file;
}

}  // namespace robosim::mcap
