#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/temporary_directory.h"
#include "mcap/reader.h"
#include "mcap/records.h"

namespace robosim::mcap {

/// A message with its data.
struct ReadMessage {
  std::string topic;
  std::uint64_t time_ns = 0;
  std::uint32_t sequence = 0;
  std::vector<std::uint8_t> data;
  bool operator==(const ReadMessage&) const = default;
};

/// The remaining messages.
std::vector<ReadMessage> readAll(Reader& reader);

/// A file with these bytes.
class FileOf {
 public:
  explicit FileOf(std::span<const std::uint8_t> bytes);
  std::filesystem::path path() const { return folder_.path() / "file.mcap"; }

 private:
  TemporaryDirectory folder_;
};

/// A file by Writer of 20 messages for each chunk, on two channels in turn, with a metadata record and an attachment.
struct SampleFile {
  explicit SampleFile(std::size_t chunks);

  std::vector<std::uint8_t> bytes;
  std::vector<ReadMessage> messages;
  Attachment attachment{5, 6, "world.xml", "text/xml", "<world/>"};
  Metadata metadata{"robosim", {{"digest", "1"}, {"seed", "7"}}};
};

/// A file of the same messages as other programs write it.
/// @param compression of chunks; "none" for no chunks
std::vector<std::uint8_t> withoutSummary(const SampleFile& sample, const std::string& compression);

}  // namespace robosim::mcap
