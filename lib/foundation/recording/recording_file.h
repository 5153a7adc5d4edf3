#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "base/atomic_file.h"

namespace robosim {

/// An AtomicFile of a recording: a killed program leaves the .part behind. Every write to the disk is checked; after an
/// error the recording is discarded.
class RecordingFile {
 public:
  /// @throws ConfigError when the file cannot be created, or another program writes its .part.
  explicit RecordingFile(const std::filesystem::path& file);

  /// @throws RecordingError when the recording has been committed or discarded
  void checkOpen() const;
  /// @throws RecordingError when they could not be written
  void write(std::span<const std::uint8_t> bytes);
  /// Waits until all is on the disk; the file is still "<name>.part". @throws RecordingError as write() does
  void finish();
  /// Finishes the file, and renames it to its name. Call at most once. @throws RecordingError as write() does
  void commit();

  const std::filesystem::path& path() const { return path_; }

 private:
  /// Calls act(), and fail() if the file cannot be written.
  template <typename Act>
  void check(const Act& act);
  [[noreturn]] void fail();

  std::optional<AtomicFile> file_;  ///< nullopt when committed or discarded
  std::filesystem::path path_;
};

}  // namespace robosim
