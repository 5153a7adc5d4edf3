#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mcap/records.h"

namespace robosim::mcap {

/// A message of a file.
struct Message {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0, publish_time_ns = 0;
  std::span<const std::uint8_t> data;  ///< valid until the next call of the reader
};

/// What a file contains, from its summary or, for a file without one, from its records.
struct Contents {
  bool has_summary = false;
  std::optional<Statistics> statistics;  ///< of the summary
  std::vector<ChunkIndex> chunks;        ///< in the order of the file; without a summary, also without message indexes
  std::vector<AttachmentIndex> attachments;
  std::vector<MetadataIndex> metadata;
};

/// Reads an MCAP file of any program: with chunks (zstd, lz4 or not compressed) or without, with or without indexes.
///
/// Messages are read in the order of the file. A file that is cut off, or damaged, is read up to the last whole chunk,
/// or the last whole message that is in none; fault() then states the reason.
class Reader {
 public:
  /// @throws ConfigError as InputFile does, and for a file that does not begin as MCAP
  explicit Reader(const std::filesystem::path& file);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  const Header& header() const;
  /// Those that have been read so far, or all after contents() of a file with a summary.
  const std::map<std::uint16_t, Schema>& schemas() const;
  const std::map<std::uint16_t, Channel>& channels() const;

  /// The next message; nullopt at the end. @throws Interrupted
  std::optional<Message> next();

  /// Where a message is: its record or that of its chunk in the file, and its record within the chunk.
  struct Place {
    std::uint64_t record = 0, in_chunk = 0;
    bool operator==(const Place&) const = default;
  };
  /// Of the message that next() has returned last.
  Place place() const;

  /// @name Not of pipes
  ///@{
  /// Continues at a message that next() has returned.
  void seek(const Place& place);
  /// Continues at the first message in the file that is at this time or later; next() leaves out messages before it.
  void seekTime(std::uint64_t time_ns);
  /// Reads the summary or, without a valid one, the beginning of each record. The position of next() is unchanged.
  const Contents& contents();
  /// @throws RecordError when it is damaged
  Attachment attachment(const AttachmentIndex& index);
  /// @throws RecordError when it is damaged
  Metadata metadata(const MetadataIndex& index);
  ///@}

  /// Why reading has ended before the end of the data; empty for none.
  const std::string& fault() const;
  /// Whether the reason is that the file ends too early.
  bool isCutOff() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim::mcap
