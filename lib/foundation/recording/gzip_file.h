#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "recording/recording_file.h"

namespace robosim {

/// A gzip file: it appears under its name only when it is complete. A killed program leaves the .part behind, readable
/// up to its end.
///
/// Compressed by Intel's ISA-L at level 0, the fastest. Every write to the disk is checked; MRPT's CFileGZOutputStream
/// does not check the last one.
class GzipFile {
 public:
  /// Maximum number of bytes passed to the compressor at once; longer writes are split.
  static constexpr std::size_t kMaxPiece = std::size_t{1} << 26;

  /// @throws ConfigError when the file cannot be created, or another program writes its .part.
  explicit GzipFile(const std::filesystem::path& file);
  ~GzipFile();
  GzipFile(const GzipFile&) = delete;
  GzipFile& operator=(const GzipFile&) = delete;

  /// Appends bytes; best in pieces of many kilobytes.
  /// @throws RecordingError when they could not be written; the recording is discarded.
  void write(std::span<const std::uint8_t> bytes);
  /// Writes the buffered data, and waits until all is on the disk; the file is still "<name>.part".
  /// @throws RecordingError as write() does.
  void finish();
  /// Finishes the file if necessary, and renames it to its name. Call at most once. Of several files that belong
  /// together, finish each, then commit each.
  /// @throws RecordingError as write() does.
  void commit();

  const std::filesystem::path& path() const { return file_.path(); }

 private:
  struct Compressor;
  void compress(std::span<const std::uint8_t> bytes, bool last);

  RecordingFile file_;
  std::unique_ptr<Compressor> compressor_;
  bool is_finished_ = false;
};

}  // namespace robosim
