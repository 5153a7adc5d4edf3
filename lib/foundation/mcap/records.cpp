#include "mcap/records.h"

#include <bit>

#include <isa-l/crc.h>

#include "base/vector_registers.h"

namespace robosim::mcap {
namespace {

std::span<const std::uint8_t> asBytes(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string asText(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

std::uint64_t RecordReader::number(std::size_t size) {
  const auto digits = bytes(size);
  std::uint64_t value = 0;
  for (std::size_t i = size; i-- > 0;) value = value << 8 | digits[i];
  return value;
}

std::span<const std::uint8_t> RecordReader::bytes(std::uint64_t size) {
  if (size > bytes_.size() - at_) {
    throw RecordError("a record of " + std::to_string(bytes_.size()) + " bytes has a field that ends after it");
  }
  const auto part = bytes_.subspan(at_, size);
  at_ += size;
  return part;
}

std::string RecordReader::text() { return asText(bytes(u32())); }

std::map<std::string, std::string> RecordReader::texts() {
  RecordReader entries(bytes(u32()));
  std::map<std::string, std::string> read;
  while (!entries.rest().empty()) {
    std::string key = entries.text();
    read[std::move(key)] = entries.text();
  }
  return read;
}

std::map<std::uint16_t, std::uint64_t> RecordReader::numbers() {
  RecordReader entries(bytes(u32()));
  std::map<std::uint16_t, std::uint64_t> read;
  while (!entries.rest().empty()) {
    const std::uint16_t key = entries.u16();
    read[key] = entries.u64();
  }
  return read;
}

void RecordWriter::number(std::uint64_t value, std::size_t size) {
  static_assert(std::endian::native == std::endian::little, "numbers are copied as they are in memory");
  const auto* const first = reinterpret_cast<const std::uint8_t*>(&value);
  bytes_.insert(bytes_.end(), first, first + size);
}

void RecordWriter::bytes(std::string_view bytes) {
  const auto added = asBytes(bytes);
  bytes_.insert(bytes_.end(), added.begin(), added.end());
}

void RecordWriter::text(std::string_view text) {
  u32(static_cast<std::uint32_t>(text.size()));
  bytes(text);
}

void RecordWriter::texts(const std::map<std::string, std::string>& texts) {
  std::size_t size = 0;
  for (const auto& [key, value] : texts) size += 8 + key.size() + value.size();
  u32(static_cast<std::uint32_t>(size));
  for (const auto& [key, value] : texts) {
    text(key);
    text(value);
  }
}

void RecordWriter::numbers(const std::map<std::uint16_t, std::uint64_t>& numbers) {
  u32(static_cast<std::uint32_t>(10 * numbers.size()));
  for (const auto& [key, value] : numbers) {
    u16(key);
    u64(value);
  }
}

std::size_t RecordWriter::begin(Opcode opcode) {
  u8(static_cast<std::uint8_t>(opcode));
  u64(0);
  return bytes_.size();
}

void RecordWriter::end(std::size_t begin) {
  const std::uint64_t length = bytes_.size() - begin;
  for (std::size_t i = 0; i < 8; ++i) bytes_[begin - 8 + i] = static_cast<std::uint8_t>(length >> (8 * i));
}

Header readHeader(std::span<const std::uint8_t> content) {
  RecordReader reader(content);
  Header header;
  header.profile = reader.text();
  header.library = reader.text();
  return header;
}

Footer readFooter(std::span<const std::uint8_t> content) {
  RecordReader reader(content);
  Footer footer;
  footer.summary_start = reader.u64();
  footer.summary_offset_start = reader.u64();
  footer.summary_crc = reader.u32();
  return footer;
}

Schema readSchema(std::span<const std::uint8_t> content) {
  RecordReader reader(content);
  Schema schema;
  schema.id = reader.u16();
  schema.name = reader.text();
  schema.encoding = reader.text();
  schema.data = reader.text();
  if (schema.id == 0) throw RecordError("schema \"" + schema.name + "\" has the id 0, which means none");
  return schema;
}

Channel readChannel(std::span<const std::uint8_t> content) {
  RecordReader reader(content);
  Channel channel;
  channel.id = reader.u16();
  channel.schema_id = reader.u16();
  channel.topic = reader.text();
  channel.message_encoding = reader.text();
  channel.metadata = reader.texts();
  return channel;
}

ChunkIndex readChunkIndex(std::span<const std::uint8_t> content) {
  RecordReader reader(content);
  ChunkIndex index;
  index.start_time = reader.u64();
  index.end_time = reader.u64();
  index.chunk_start = reader.u64();
  index.chunk_length = reader.u64();
  index.message_index_offsets = reader.numbers();
  index.message_index_length = reader.u64();
  index.compression = reader.text();
  index.compressed_size = reader.u64();
  index.uncompressed_size = reader.u64();
  return index;
}

Attachment readAttachment(std::span<const std::uint8_t> content, bool has_data) {
  RecordReader reader(content);
  Attachment attachment;
  attachment.log_time = reader.u64();
  attachment.create_time = reader.u64();
  attachment.name = reader.text();
  attachment.media_type = reader.text();
  if (!has_data) return attachment;
  attachment.data = asText(reader.bytes(reader.u64()));
  const std::size_t checked = content.size() - reader.rest().size();
  const std::uint32_t crc = reader.u32();
  if (crc != 0 && crc != crcOf(content.first(checked))) {
    throw RecordError("attachment \"" + attachment.name + "\" does not match its checksum");
  }
  return attachment;
}

AttachmentIndex readAttachmentIndex(std::span<const std::uint8_t> content) {
  RecordReader reader(content);
  AttachmentIndex index;
  index.offset = reader.u64();
  index.length = reader.u64();
  index.log_time = reader.u64();
  index.create_time = reader.u64();
  index.data_size = reader.u64();
  index.name = reader.text();
  index.media_type = reader.text();
  return index;
}

Metadata readMetadata(std::span<const std::uint8_t> content) {
  RecordReader reader(content);
  Metadata metadata;
  metadata.name = reader.text();
  metadata.values = reader.texts();
  return metadata;
}

MetadataIndex readMetadataIndex(std::span<const std::uint8_t> content) {
  RecordReader reader(content);
  MetadataIndex index;
  index.offset = reader.u64();
  index.length = reader.u64();
  index.name = reader.text();
  return index;
}

Statistics readStatistics(std::span<const std::uint8_t> content) {
  RecordReader reader(content);
  Statistics statistics;
  statistics.messages = reader.u64();
  statistics.schemas = reader.u16();
  statistics.channels = reader.u32();
  statistics.attachments = reader.u32();
  statistics.metadata = reader.u32();
  statistics.chunks = reader.u32();
  statistics.start_time = reader.u64();
  statistics.end_time = reader.u64();
  statistics.messages_by_channel = reader.numbers();
  return statistics;
}

void append(std::vector<std::uint8_t>& bytes, const Header& header) {
  RecordWriter writer(bytes);
  const std::size_t begin = writer.begin(Opcode::header);
  writer.text(header.profile);
  writer.text(header.library);
  writer.end(begin);
}

void append(std::vector<std::uint8_t>& bytes, const Schema& schema) {
  RecordWriter writer(bytes);
  const std::size_t begin = writer.begin(Opcode::schema);
  writer.u16(schema.id);
  writer.text(schema.name);
  writer.text(schema.encoding);
  writer.text(schema.data);
  writer.end(begin);
}

void append(std::vector<std::uint8_t>& bytes, const Channel& channel) {
  RecordWriter writer(bytes);
  const std::size_t begin = writer.begin(Opcode::channel);
  writer.u16(channel.id);
  writer.u16(channel.schema_id);
  writer.text(channel.topic);
  writer.text(channel.message_encoding);
  writer.texts(channel.metadata);
  writer.end(begin);
}

void append(std::vector<std::uint8_t>& bytes, const ChunkIndex& index) {
  RecordWriter writer(bytes);
  const std::size_t begin = writer.begin(Opcode::chunk_index);
  writer.u64(index.start_time);
  writer.u64(index.end_time);
  writer.u64(index.chunk_start);
  writer.u64(index.chunk_length);
  writer.numbers(index.message_index_offsets);
  writer.u64(index.message_index_length);
  writer.text(index.compression);
  writer.u64(index.compressed_size);
  writer.u64(index.uncompressed_size);
  writer.end(begin);
}

void append(std::vector<std::uint8_t>& bytes, const Attachment& attachment) {
  RecordWriter writer(bytes);
  const std::size_t begin = writer.begin(Opcode::attachment);
  writer.u64(attachment.log_time);
  writer.u64(attachment.create_time);
  writer.text(attachment.name);
  writer.text(attachment.media_type);
  writer.u64(attachment.data.size());
  writer.bytes(attachment.data);
  writer.u32(crcOf(std::span(bytes).subspan(begin)));
  writer.end(begin);
}

void append(std::vector<std::uint8_t>& bytes, const AttachmentIndex& index) {
  RecordWriter writer(bytes);
  const std::size_t begin = writer.begin(Opcode::attachment_index);
  writer.u64(index.offset);
  writer.u64(index.length);
  writer.u64(index.log_time);
  writer.u64(index.create_time);
  writer.u64(index.data_size);
  writer.text(index.name);
  writer.text(index.media_type);
  writer.end(begin);
}

void append(std::vector<std::uint8_t>& bytes, const Metadata& metadata) {
  RecordWriter writer(bytes);
  const std::size_t begin = writer.begin(Opcode::metadata);
  writer.text(metadata.name);
  writer.texts(metadata.values);
  writer.end(begin);
}

void append(std::vector<std::uint8_t>& bytes, const MetadataIndex& index) {
  RecordWriter writer(bytes);
  const std::size_t begin = writer.begin(Opcode::metadata_index);
  writer.u64(index.offset);
  writer.u64(index.length);
  writer.text(index.name);
  writer.end(begin);
}

void append(std::vector<std::uint8_t>& bytes, const Statistics& statistics) {
  RecordWriter writer(bytes);
  const std::size_t begin = writer.begin(Opcode::statistics);
  writer.u64(statistics.messages);
  writer.u16(statistics.schemas);
  writer.u32(statistics.channels);
  writer.u32(statistics.attachments);
  writer.u32(statistics.metadata);
  writer.u32(statistics.chunks);
  writer.u64(statistics.start_time);
  writer.u64(statistics.end_time);
  writer.numbers(statistics.messages_by_channel);
  writer.end(begin);
}

std::uint32_t crcOf(std::span<const std::uint8_t> bytes, std::uint32_t before) {
  const std::uint32_t crc = crc32_gzip_refl(before, bytes.data(), bytes.size());
  clearVectorRegisters();
  return crc;
}

}  // namespace robosim::mcap
