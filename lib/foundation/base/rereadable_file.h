#pragma once
#include <filesystem>

namespace robosim {

/// A file that can be read several times and at any position: the file itself (also a folder), or a temporary copy of a
/// pipe's content.
/// The copy has no directory entry, so that it is deleted with the process.
class RereadableFile {
 public:
  /// Reads a pipe to its end. @throws ConfigError as InputFile does; Interrupted; std::system_error on a full disk
  explicit RereadableFile(const std::filesystem::path& file);
  ~RereadableFile();
  RereadableFile(const RereadableFile&) = delete;
  RereadableFile& operator=(const RereadableFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int copy_ = -1;
};

}  // namespace robosim
