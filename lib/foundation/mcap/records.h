#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

/// @file
/// The records of an MCAP file and their bytes. Source: https://mcap.dev/spec (foxglove/mcap, website/docs/spec). All
/// numbers are little-endian; times are in nanoseconds.
namespace robosim::mcap {

/// At the beginning and the end of a file.
inline constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

enum class Opcode : std::uint8_t {
  header = 1,
  footer,
  schema,
  channel,
  message,
  chunk,
  message_index,
  chunk_index,
  attachment,
  attachment_index,
  statistics,
  metadata,
  metadata_index,
  summary_offset,
  data_end,
};

/// Size of a record before its content: opcode and length.
inline constexpr std::size_t kRecordPrefixBytes = 9;
inline constexpr std::size_t kFooterBytes = 20;

/// Records whose content is their fields in order have describe(), which visits these; reading and writing derive from
/// it.
struct Header {
  std::string profile, library;
  static constexpr Opcode kOpcode = Opcode::header;
  static void describe(auto& self, auto&& visit) {
    visit(self.profile);
    visit(self.library);
  }
};
struct Footer {
  std::uint64_t summary_start = 0;         ///< 0 for a file without a summary
  std::uint64_t summary_offset_start = 0;  ///< 0 for none
  std::uint32_t summary_crc = 0;           ///< 0 for none
  static constexpr Opcode kOpcode = Opcode::footer;
  static void describe(auto& self, auto&& visit) {
    visit(self.summary_start);
    visit(self.summary_offset_start);
    visit(self.summary_crc);
  }
};
struct Schema {
  std::uint16_t id = 0;  ///< not 0
  std::string name, encoding;
  std::string data;
  static constexpr Opcode kOpcode = Opcode::schema;
  static void describe(auto& self, auto&& visit) {
    visit(self.id);
    visit(self.name);
    visit(self.encoding);
    visit(self.data);
  }
  bool operator==(const Schema&) const = default;
};
struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;  ///< 0 for no schema
  std::string topic, message_encoding;
  std::map<std::string, std::string> metadata;
  static constexpr Opcode kOpcode = Opcode::channel;
  static void describe(auto& self, auto&& visit) {
    visit(self.id);
    visit(self.schema_id);
    visit(self.topic);
    visit(self.message_encoding);
    visit(self.metadata);
  }
  bool operator==(const Channel&) const = default;
};
struct Chunk {
  std::uint64_t start_time = 0, end_time = 0, uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;  ///< 0 for none
  std::string compression;             ///< "", "lz4" or "zstd"
};
struct ChunkIndex {
  std::uint64_t start_time = 0, end_time = 0;
  std::uint64_t chunk_start = 0, chunk_length = 0;               ///< of the whole record
  std::map<std::uint16_t, std::uint64_t> message_index_offsets;  ///< by channel, in the file
  std::uint64_t message_index_length = 0;
  std::string compression;
  std::uint64_t compressed_size = 0, uncompressed_size = 0;
  static constexpr Opcode kOpcode = Opcode::chunk_index;
  static void describe(auto& self, auto&& visit) {
    visit(self.start_time);
    visit(self.end_time);
    visit(self.chunk_start);
    visit(self.chunk_length);
    visit(self.message_index_offsets);
    visit(self.message_index_length);
    visit(self.compression);
    visit(self.compressed_size);
    visit(self.uncompressed_size);
  }
};
struct Attachment {
  std::uint64_t log_time = 0, create_time = 0;
  std::string name, media_type;
  std::string data;
  bool operator==(const Attachment&) const = default;
};
struct AttachmentIndex {
  std::uint64_t offset = 0, length = 0, log_time = 0, create_time = 0, data_size = 0;
  std::string name, media_type;
  static constexpr Opcode kOpcode = Opcode::attachment_index;
  static void describe(auto& self, auto&& visit) {
    visit(self.offset);
    visit(self.length);
    visit(self.log_time);
    visit(self.create_time);
    visit(self.data_size);
    visit(self.name);
    visit(self.media_type);
  }
};
struct Metadata {
  std::string name;
  std::map<std::string, std::string> values;
  static constexpr Opcode kOpcode = Opcode::metadata;
  static void describe(auto& self, auto&& visit) {
    visit(self.name);
    visit(self.values);
  }
  bool operator==(const Metadata&) const = default;
};
struct MetadataIndex {
  std::uint64_t offset = 0, length = 0;
  std::string name;
  static constexpr Opcode kOpcode = Opcode::metadata_index;
  static void describe(auto& self, auto&& visit) {
    visit(self.offset);
    visit(self.length);
    visit(self.name);
  }
};
struct Statistics {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0, attachments = 0, metadata = 0, chunks = 0;
  std::uint64_t start_time = 0, end_time = 0;  ///< of the messages; 0 for none
  std::map<std::uint16_t, std::uint64_t> messages_by_channel;
  static constexpr Opcode kOpcode = Opcode::statistics;
  static void describe(auto& self, auto&& visit) {
    visit(self.messages);
    visit(self.schemas);
    visit(self.channels);
    visit(self.attachments);
    visit(self.metadata);
    visit(self.chunks);
    visit(self.start_time);
    visit(self.end_time);
    visit(self.messages_by_channel);
  }
};

/// Content of a record that is not of its kind.
class RecordError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads the content of a record.
class RecordReader {
 public:
  explicit RecordReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint8_t u8() { return static_cast<std::uint8_t>(number(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  std::uint64_t u64() { return number(8); }
  std::string text();
  std::span<const std::uint8_t> bytes(std::uint64_t size);
  /// What has not been read.
  std::span<const std::uint8_t> rest() const { return bytes_.subspan(at_); }

  /// @name A field, by its type
  ///@{
  void read(std::uint16_t& value) { value = u16(); }
  void read(std::uint32_t& value) { value = u32(); }
  void read(std::uint64_t& value) { value = u64(); }
  void read(std::string& value) { value = text(); }
  void read(std::map<std::string, std::string>& texts);
  void read(std::map<std::uint16_t, std::uint64_t>& numbers);
  ///@}

 private:
  std::uint64_t number(std::size_t size);

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

/// Appends the bytes of records.
class RecordWriter {
 public:
  explicit RecordWriter(std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  void u8(std::uint8_t value) { bytes_.push_back(value); }
  void u16(std::uint16_t value) { number(value, 2); }
  void u32(std::uint32_t value) { number(value, 4); }
  void u64(std::uint64_t value) { number(value, 8); }
  void text(std::string_view text);
  void bytes(std::string_view bytes);
  /// @name A field, by its type
  ///@{
  void write(std::uint16_t value) { u16(value); }
  void write(std::uint32_t value) { u32(value); }
  void write(std::uint64_t value) { u64(value); }
  void write(const std::string& value) { text(value); }
  void write(const std::map<std::string, std::string>& texts);
  void write(const std::map<std::uint16_t, std::uint64_t>& numbers);
  ///@}
  /// Begins a record; its length is set by end(). @returns what end() takes
  std::size_t begin(Opcode opcode);
  void end(std::size_t begin);

 private:
  void number(std::uint64_t value, std::size_t size);

  std::vector<std::uint8_t>& bytes_;
};

/// The content of a record. Bytes after the known ones are ignored, as the format requires. @throws RecordError
template <typename Record>
Record read(std::span<const std::uint8_t> content) {
  Record record;
  RecordReader reader(content);
  Record::describe(record, [&reader](auto& field) { reader.read(field); });
  return record;
}
/// @throws RecordError also for an id of 0
template <>
Schema read<Schema>(std::span<const std::uint8_t> content);
/// @param has_data false to leave the data empty and the checksum unchecked @throws RecordError
Attachment readAttachment(std::span<const std::uint8_t> content, bool has_data = true);

/// Appends a whole record.
template <typename Record>
void append(std::vector<std::uint8_t>& bytes, const Record& record) {
  RecordWriter writer(bytes);
  const std::size_t begin = writer.begin(Record::kOpcode);
  Record::describe(record, [&writer](const auto& field) { writer.write(field); });
  writer.end(begin);
}
void append(std::vector<std::uint8_t>& bytes, const Attachment& attachment);

/// CRC-32 of zlib. @param before of the bytes before these
std::uint32_t crcOf(std::span<const std::uint8_t> bytes, std::uint32_t before = 0);

}  // namespace robosim::mcap
