#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace robosim {

/// Reads the bytes of a file, decompressed if it is a gzip file; of an MCAP file of RoboSim, those of the rawlog in it
/// (McapRecording). With random access, it can seek to any byte that was
/// read before: about every 4 MiB it stores a checkpoint of 32 KiB from which decompression can continue (as zlib's
/// examples/zran.c).
class UnpackedFile {
 public:
  enum class Access { sequential, random };

  /// @param access random: regular files only.
  /// @throws ConfigError as InputFile does, and for an MCAP file without a rawlog or from a pipe.
  explicit UnpackedFile(const std::filesystem::path& file, Access access = Access::sequential);
  ~UnpackedFile();
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  /// @returns the number of bytes read: less than `size` only at the end or before an error. @throws Interrupted
  std::size_t read(void* to, std::size_t size);
  /// As read(), without advancing the position. @param size at most 1 KiB
  std::size_t peek(void* to, std::size_t size);
  /// Position of the next byte in the decompressed data.
  std::uint64_t position() const;
  /// Continues at a byte that was read before, or at the next one; requires random access.
  void seek(std::uint64_t position);
  /// Position in the file of the end of a gzip member all of whose content has been read; nullopt within a member.
  std::optional<std::uint64_t> endOfMember();
  /// Continues at a gzip member, whose position in the file is known, as if all before it had been read.
  /// @pre the file is a gzip file
  void seekMember(std::uint64_t packed, std::uint64_t unpacked);
  /// Notes where a gzip member begins, so that seek() continues there for the bytes that follow, also if they were not
  /// read. Requires random access. If a member that is read is none of those noted, all notes are wrong, and forgotten.
  /// @pre later in the file than those that were noted before
  void noteMember(std::uint64_t packed, std::uint64_t unpacked);

  /// Whether the file was read completely and without error.
  bool atEnd();
  /// Description of the error at which reading ended; empty for none so far.
  const std::string& fault() const;
  /// Whether the error is that a compressed file ends too early.
  bool isCutOff() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
