#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "recording/member_index.h"
#include "recording/recording_file.h"

namespace robosim {

/// A gzip file of members with an index (doc/rawlog.md#file): it appears under its name only when it is complete. A
/// killed program leaves the .part behind, readable up to its last member.
///
/// Compressed by Intel's ISA-L at level 0, the fastest. Every write to the disk is checked; MRPT's CFileGZOutputStream
/// does not check the last one.
class GzipFile {
 public:
  /// Maximum number of bytes passed to the compressor at once; longer writes are split.
  static constexpr std::size_t kMaxPiece = std::size_t{1} << 26;
  /// Content of a member after which the next one begins at the next step (endMember()).
  static constexpr std::size_t kMemberBytes = std::size_t{1} << 19;
  /// The same in the middle of a step.
  static constexpr std::size_t kMaxMemberBytes = std::size_t{1} << 23;

  /// @throws ConfigError when the file cannot be created, or another program writes its .part.
  explicit GzipFile(const std::filesystem::path& file);
  ~GzipFile();
  GzipFile(const GzipFile&) = delete;
  GzipFile& operator=(const GzipFile&) = delete;

  /// Appends bytes to the present member; best in pieces of many kilobytes.
  /// @throws RecordingError when they could not be written; the recording is discarded.
  void write(std::span<const std::uint8_t> bytes);
  /// Number of bytes of the present member's content so far.
  std::size_t memberBytes() const { return member_bytes_; }
  /// Ends the present member, if it has content. Entries of a rawlog may not be divided among members.
  /// @param note of this member for the index, in which the positions are set
  /// @throws RecordingError as write() does.
  void endMember(MemberNote note = {});
  /// Writes the buffered data and the index, and waits until all is on the disk; the file is still "<name>.part".
  /// @param last note of the last member @param summary for the index, in which the size is set
  /// @throws RecordingError as write() does.
  void finish(MemberNote last = {}, IndexSummary summary = {});
  /// Finishes the file if necessary, and renames it to its name. Call at most once. Of several files that belong
  /// together, finish each, then commit each.
  /// @throws RecordingError as write() does.
  void commit();

  const std::filesystem::path& path() const { return file_.path(); }

 private:
  struct Member;
  void append(std::span<const std::uint8_t> bytes);
  void writePages(std::size_t from_bytes);

  RecordingFile file_;
  std::unique_ptr<Member> member_;  ///< the present one
  std::size_t member_bytes_ = 0;
  std::uint64_t packed_ = 0, unpacked_ = 0;  ///< sizes of the file and of the content of its members
  std::vector<std::uint8_t> index_;          ///< what follows in the index's stream
  std::uint64_t last_page_;
  bool is_finished_ = false;
};

}  // namespace robosim
