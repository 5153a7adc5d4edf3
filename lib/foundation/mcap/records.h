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

struct Header {
  std::string profile, library;
};
struct Footer {
  std::uint64_t summary_start = 0;         ///< 0 for a file without a summary
  std::uint64_t summary_offset_start = 0;  ///< 0 for none
  std::uint32_t summary_crc = 0;           ///< 0 for none
};
struct Schema {
  std::uint16_t id = 0;  ///< not 0
  std::string name, encoding;
  std::string data;
  bool operator==(const Schema&) const = default;
};
struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;  ///< 0 for no schema
  std::string topic, message_encoding;
  std::map<std::string, std::string> metadata;
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
};
struct Metadata {
  std::string name;
  std::map<std::string, std::string> values;
  bool operator==(const Metadata&) const = default;
};
struct MetadataIndex {
  std::uint64_t offset = 0, length = 0;
  std::string name;
};
struct Statistics {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0, attachments = 0, metadata = 0, chunks = 0;
  std::uint64_t start_time = 0, end_time = 0;  ///< of the messages; 0 for none
  std::map<std::uint16_t, std::uint64_t> messages_by_channel;
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
  std::map<std::string, std::string> texts();
  std::map<std::uint16_t, std::uint64_t> numbers();

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
  void texts(const std::map<std::string, std::string>& texts);
  void numbers(const std::map<std::uint16_t, std::uint64_t>& numbers);
  /// Begins a record; its length is set by end(). @returns what end() takes
  std::size_t begin(Opcode opcode);
  void end(std::size_t begin);

 private:
  void number(std::uint64_t value, std::size_t size);

  std::vector<std::uint8_t>& bytes_;
};

/// @name The content of records
/// Bytes after the known ones are ignored, as the format requires. @throws RecordError
///@{
Header readHeader(std::span<const std::uint8_t>);
Footer readFooter(std::span<const std::uint8_t>);
Schema readSchema(std::span<const std::uint8_t>);
Channel readChannel(std::span<const std::uint8_t>);
ChunkIndex readChunkIndex(std::span<const std::uint8_t>);
/// @param has_data false to leave the data empty and the checksum unchecked
Attachment readAttachment(std::span<const std::uint8_t>, bool has_data = true);
AttachmentIndex readAttachmentIndex(std::span<const std::uint8_t>);
Metadata readMetadata(std::span<const std::uint8_t>);
MetadataIndex readMetadataIndex(std::span<const std::uint8_t>);
Statistics readStatistics(std::span<const std::uint8_t>);
///@}

/// @name Whole records
///@{
void append(std::vector<std::uint8_t>&, const Header&);
void append(std::vector<std::uint8_t>&, const Schema&);
void append(std::vector<std::uint8_t>&, const Channel&);
void append(std::vector<std::uint8_t>&, const ChunkIndex&);
void append(std::vector<std::uint8_t>&, const Attachment&);
void append(std::vector<std::uint8_t>&, const AttachmentIndex&);
void append(std::vector<std::uint8_t>&, const Metadata&);
void append(std::vector<std::uint8_t>&, const MetadataIndex&);
void append(std::vector<std::uint8_t>&, const Statistics&);
///@}

/// CRC-32 of zlib. @param before of the bytes before these
std::uint32_t crcOf(std::span<const std::uint8_t> bytes, std::uint32_t before = 0);

}  // namespace robosim::mcap
