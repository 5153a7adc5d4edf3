#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mcap/records.h"

namespace robosim::mcap {

/// Writes an MCAP file of zstd chunks with message indexes, a summary with statistics, indexes and offsets, and
/// checksums of chunks, attachments and summary. A chunk contains the schemas and channels that its messages use for
/// the first time, so that a file that is cut off can be read to its last whole chunk.
class Writer {
 public:
  /// Takes the bytes of the file in order.
  using Sink = std::function<void(std::span<const std::uint8_t>)>;
  /// Default size of a chunk's records [bytes].
  static constexpr std::size_t kChunkBytes = 1 << 20;

  /// @param chunk_bytes a chunk is written when its records have this size, or more
  Writer(Sink sink, const Header& header, std::size_t chunk_bytes = kChunkBytes);
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Id for channels. @param schema without id @throws std::length_error beyond 65,535
  std::uint16_t addSchema(Schema schema);
  /// Id for messages. @param channel without id @throws std::length_error beyond 65,535
  std::uint16_t addChannel(Channel channel);

  void write(std::uint16_t channel, std::uint64_t time_ns, std::span<const std::uint8_t> data);
  /// Begins a message. @returns the bytes to which its data is appended; endMessage() follows
  std::vector<std::uint8_t>& beginMessage(std::uint16_t channel, std::uint64_t time_ns);
  void endMessage();
  void attach(const Attachment& attachment);
  void addMetadata(const Metadata& metadata);

  /// Writes the last chunk and the summary. Nothing may be added afterwards.
  void finish();

 private:
  /// A message in the present chunk.
  struct IndexEntry {
    std::uint64_t time_ns, offset;
  };
  struct ChannelState {
    Channel channel;
    bool is_written = false;
    std::uint32_t sequence = 0;
    std::uint64_t messages = 0;
    std::vector<IndexEntry> in_chunk{};
  };
  struct MessageHead;
  struct Packer;

  /// Appends the beginning of a message's record, and what must precede it.
  void appendHead(std::uint16_t channel, std::uint64_t time_ns, std::size_t data_bytes);
  void writeChunk();
  void put(std::span<const std::uint8_t> bytes);
  void writeSummary();

  Sink sink_;
  std::size_t chunk_bytes_;
  std::unique_ptr<Packer> packer_;
  std::uint64_t position_ = 0;         ///< in the file
  std::vector<std::uint8_t> records_;  ///< of the present chunk
  std::size_t message_ = 0;            ///< where the message of beginMessage() begins in records_
  std::vector<std::uint8_t> packed_;   ///< reused
  std::uint64_t chunk_start_ns_ = 0, chunk_end_ns_ = 0;
  bool has_messages_ = false;  ///< in the present chunk
  std::vector<Schema> schemas_;
  std::vector<std::uint8_t> is_schema_written_;
  std::vector<ChannelState> channels_;
  std::vector<ChunkIndex> chunks_;
  std::vector<AttachmentIndex> attachments_;
  std::vector<MetadataIndex> metadata_;
  Statistics statistics_;
};

}  // namespace robosim::mcap
