#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace robosim {

/// A gzip file that stands under its name only when it is whole. Until commit() it grows as "<name>.part"; whatever had
/// the name before stays as it was. Destroyed without commit(), it removes the .part; a program that is killed leaves
/// it behind, and it can be read up to where it ends.
///
/// Compressed by Intel's ISA-L at its level 0, which takes the least time. Every write to the
/// disk is checked, which MRPT's CFileGZOutputStream leaves out for the last one.
class GzipFile {
 public:
  /// @throws ConfigError when there can be no such file, or another program is at work on its .part.
  explicit GzipFile(const std::filesystem::path& file);
  ~GzipFile();
  GzipFile(const GzipFile&) = delete;
  GzipFile& operator=(const GzipFile&) = delete;

  /// Appends bytes; best in pieces of many kilobytes.
  /// @throws RecordingError when they could not be written: the recording is given up.
  void write(std::span<const std::uint8_t> bytes);
  /// Waits until all is on the disk, and gives the file its name. Only once.
  /// @throws RecordingError as write() does.
  void commit();

  const std::filesystem::path& path() const { return path_; }

 private:
  struct Compressor;
  void compress(std::span<const std::uint8_t> bytes, bool last);
  [[noreturn]] void giveUp(int error);
  void discard();

  std::filesystem::path path_;
  std::filesystem::path part_;
  std::unique_ptr<Compressor> compressor_;
  int descriptor_ = -1;  ///< -1 when committed or given up
};

}  // namespace robosim
