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

void RecordReader::read(std::map<std::string, std::string>& texts) {
  RecordReader entries(bytes(u32()));
  texts.clear();
  while (!entries.rest().empty()) {
    std::string key = entries.text();
    texts[std::move(key)] = entries.text();
  }
}

void RecordReader::read(std::map<std::uint16_t, std::uint64_t>& numbers) {
  RecordReader entries(bytes(u32()));
  numbers.clear();
  while (!entries.rest().empty()) {
    const std::uint16_t key = entries.u16();
    numbers[key] = entries.u64();
  }
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

void RecordWriter::write(const std::map<std::string, std::string>& texts) {
  std::size_t size = 0;
  for (const auto& [key, value] : texts) size += 8 + key.size() + value.size();
  u32(static_cast<std::uint32_t>(size));
  for (const auto& [key, value] : texts) {
    text(key);
    text(value);
  }
}

void RecordWriter::write(const std::map<std::uint16_t, std::uint64_t>& numbers) {
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

template <>
Schema read<Schema>(std::span<const std::uint8_t> content) {
  RecordReader reader(content);
  Schema schema;
  Schema::describe(schema, [&reader](auto& field) { reader.read(field); });
  if (schema.id == 0) throw RecordError("schema \"" + schema.name + "\" has the id 0, which means none");
  return schema;
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

std::uint32_t crcOf(std::span<const std::uint8_t> bytes, std::uint32_t before) {
  const std::uint32_t crc = crc32_gzip_refl(before, bytes.data(), bytes.size());
  clearVectorRegisters();
  return crc;
}

}  // namespace robosim::mcap
