#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
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
