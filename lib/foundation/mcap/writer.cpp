#include "mcap/writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "mcap/compression.h"

namespace robosim::mcap {
namespace {

std::uint16_t nextId(std::size_t count, const char* what) {
  if (count > 65'535) throw std::length_error(std::string("an MCAP file has at most 65,535 ") + what);
  return static_cast<std::uint16_t>(count);
}

/// Bytes of a message's record before its data: channel, sequence number and two times.
constexpr std::size_t kMessageHeadBytes = 2 + 4 + 8 + 8;
static_assert(std::endian::native == std::endian::little, "numbers are copied as they are in memory");

std::span<const std::uint8_t> magic() { return {reinterpret_cast<const std::uint8_t*>(kMagic.data()), kMagic.size()}; }

}  // namespace

/// What precedes the data of a message.
struct Writer::MessageHead {
  std::array<std::uint8_t, kRecordPrefixBytes + kMessageHeadBytes> bytes{static_cast<std::uint8_t>(Opcode::message)};
  template <typename Number>
  void set(std::size_t position, Number number) {
    std::memcpy(bytes.data() + position, &number, sizeof number);
  }
};

struct Writer::Packer {
  ZstdPacker zstd;
};

Writer::Writer(Sink sink, const Header& header, std::size_t chunk_bytes)
    : sink_(std::move(sink)), chunk_bytes_(chunk_bytes), packer_(std::make_unique<Packer>()) {
  put(magic());
  std::vector<std::uint8_t> bytes;
  append(bytes, header);
  put(bytes);
}

Writer::~Writer() = default;

std::uint16_t Writer::addSchema(Schema schema) {
  schema.id = nextId(schemas_.size() + 1, "schemas");
  schemas_.push_back(std::move(schema));
  is_schema_written_.push_back(0);
  return schemas_.back().id;
}

std::uint16_t Writer::addChannel(Channel channel) {
  assert(channel.schema_id <= schemas_.size());
  channel.id = nextId(channels_.size(), "channels");
  channels_.push_back({std::move(channel)});
  return channels_.back().channel.id;
}

void Writer::appendHead(std::uint16_t id, std::uint64_t time_ns, std::size_t data_bytes) {
  ChannelState& state = channels_.at(id);
  if (!std::exchange(state.is_written, true)) {
    const std::uint16_t schema = state.channel.schema_id;
    if (schema > 0 && std::exchange(is_schema_written_[schema - 1], 1) == 0) append(records_, schemas_[schema - 1]);
    append(records_, state.channel);
  }
  state.in_chunk.push_back({time_ns, records_.size()});
  chunk_start_ns_ = has_messages_ ? std::min(chunk_start_ns_, time_ns) : time_ns;
  chunk_end_ns_ = has_messages_ ? std::max(chunk_end_ns_, time_ns) : time_ns;
  has_messages_ = true;
  ++state.messages;
  MessageHead head;
  head.set(kRecordPrefixBytes - 8, kMessageHeadBytes + data_bytes);
  head.set(kRecordPrefixBytes, id);
  head.set(kRecordPrefixBytes + 2, state.sequence++);
  head.set(kRecordPrefixBytes + 6, time_ns);   // of recording
  head.set(kRecordPrefixBytes + 14, time_ns);  // of publishing
  records_.insert(records_.end(), head.bytes.begin(), head.bytes.end());
}

std::vector<std::uint8_t>& Writer::beginMessage(std::uint16_t channel, std::uint64_t time_ns) {
  appendHead(channel, time_ns, 0);
  message_ = records_.size() - kMessageHeadBytes;
  return records_;
}

void Writer::write(std::uint16_t channel, std::uint64_t time_ns, std::span<const std::uint8_t> data) {
  appendHead(channel, time_ns, data.size());
  records_.insert(records_.end(), data.begin(), data.end());
  if (records_.size() >= chunk_bytes_) writeChunk();
}

void Writer::endMessage() {
  RecordWriter(records_).end(message_);
  if (records_.size() >= chunk_bytes_) writeChunk();
}

void Writer::writeChunk() {
  if (records_.empty()) return;
  ChunkIndex index;
  index.start_time = chunk_start_ns_;
  index.end_time = chunk_end_ns_;
  index.chunk_start = position_;
  index.compression = "zstd";
  index.uncompressed_size = records_.size();

  packed_.clear();
  RecordWriter writer(packed_);
  const std::size_t begin = writer.begin(Opcode::chunk);
  writer.u64(index.start_time);
  writer.u64(index.end_time);
  writer.u64(index.uncompressed_size);
  writer.u32(crcOf(records_));
  writer.text(index.compression);
  const std::size_t before_size = packed_.size();
  writer.u64(0);
  packer_->zstd.pack(records_, packed_);
  index.compressed_size = packed_.size() - before_size - 8;
  for (std::size_t i = 0; i < 8; ++i) {
    packed_[before_size + i] = static_cast<std::uint8_t>(index.compressed_size >> (8 * i));
  }
  writer.end(begin);
  index.chunk_length = packed_.size();

  for (auto& state : channels_) {
    if (state.in_chunk.empty()) continue;
    index.message_index_offsets[state.channel.id] = position_ + packed_.size();
    const std::size_t begin_index = writer.begin(Opcode::message_index);
    writer.u16(state.channel.id);
    writer.u32(static_cast<std::uint32_t>(16 * state.in_chunk.size()));
    static_assert(sizeof(IndexEntry) == 16, "written as it is in memory");
    const auto* const entries = reinterpret_cast<const std::uint8_t*>(state.in_chunk.data());
    packed_.insert(packed_.end(), entries, entries + state.in_chunk.size() * sizeof(IndexEntry));
    writer.end(begin_index);
    state.in_chunk.clear();
  }
  index.message_index_length = packed_.size() - index.chunk_length;
  put(packed_);
  statistics_.start_time = chunks_.empty() ? chunk_start_ns_ : std::min(statistics_.start_time, chunk_start_ns_);
  statistics_.end_time = std::max(statistics_.end_time, chunk_end_ns_);
  chunks_.push_back(std::move(index));
  records_.clear();
  has_messages_ = false;
}

void Writer::attach(const Attachment& attachment) {
  std::vector<std::uint8_t> bytes;
  append(bytes, attachment);
  attachments_.push_back({position_, bytes.size(), attachment.log_time, attachment.create_time, attachment.data.size(),
                          attachment.name, attachment.media_type});
  put(bytes);
}

void Writer::addMetadata(const Metadata& metadata) {
  std::vector<std::uint8_t> bytes;
  append(bytes, metadata);
  metadata_.push_back({position_, bytes.size(), metadata.name});
  put(bytes);
}

void Writer::finish() {
  writeChunk();
  std::vector<std::uint8_t> bytes;
  RecordWriter writer(bytes);
  const std::size_t begin = writer.begin(Opcode::data_end);
  writer.u32(0);  // no checksum of all data: chunks and attachments have their own
  writer.end(begin);
  put(bytes);
  writeSummary();
}

void Writer::writeSummary() {
  const std::uint64_t start = position_;
  std::vector<std::uint8_t> summary, offsets;
  const auto addGroup = [&](Opcode opcode, const auto& records) {
    const std::size_t group_start = summary.size();
    for (const auto& record : records) append(summary, record);
    if (summary.size() == group_start) return;
    RecordWriter writer(offsets);
    const std::size_t begin = writer.begin(Opcode::summary_offset);
    writer.u8(static_cast<std::uint8_t>(opcode));
    writer.u64(start + group_start);
    writer.u64(summary.size() - group_start);
    writer.end(begin);
  };
  std::vector<Channel> channels;
  for (const auto& state : channels_) {
    channels.push_back(state.channel);
    statistics_.messages += state.messages;
    if (state.messages > 0) statistics_.messages_by_channel[state.channel.id] = state.messages;
  }
  statistics_.schemas = static_cast<std::uint16_t>(schemas_.size());
  statistics_.channels = static_cast<std::uint32_t>(channels.size());
  statistics_.attachments = static_cast<std::uint32_t>(attachments_.size());
  statistics_.metadata = static_cast<std::uint32_t>(metadata_.size());
  statistics_.chunks = static_cast<std::uint32_t>(chunks_.size());
  addGroup(Opcode::schema, schemas_);
  addGroup(Opcode::channel, channels);
  addGroup(Opcode::statistics, std::span(&statistics_, 1));
  addGroup(Opcode::chunk_index, chunks_);
  addGroup(Opcode::attachment_index, attachments_);
  addGroup(Opcode::metadata_index, metadata_);

  const std::uint64_t offsets_start = start + summary.size();
  summary.insert(summary.end(), offsets.begin(), offsets.end());
  RecordWriter writer(summary);
  const std::size_t begin = writer.begin(Opcode::footer);
  writer.u64(start);
  writer.u64(offsets_start);
  writer.u32(0);
  writer.end(begin);
  // The checksum covers the length of the footer, too.
  const std::uint32_t crc = crcOf(std::span(summary).first(summary.size() - 4));
  for (std::size_t i = 0; i < 4; ++i) summary[summary.size() - 4 + i] = static_cast<std::uint8_t>(crc >> (8 * i));
  put(summary);
  put(magic());
}

void Writer::put(std::span<const std::uint8_t> bytes) {
  sink_(bytes);
  position_ += bytes.size();
}

}  // namespace robosim::mcap
