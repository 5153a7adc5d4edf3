#pragma once
#include <filesystem>

namespace robosim {

/// A new folder among the system's temporary ones, gone with all that is in it at the end.
class ScratchFolder {
 public:
  /// @throws std::runtime_error when there is no room for one
  ScratchFolder();
  /// In memory, where the system has such a place: to measure what a program does, not how soon a disk has all of it.
  static ScratchFolder inMemory();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

 private:
  explicit ScratchFolder(const std::filesystem::path& parent);

  std::filesystem::path path_;
};

}  // namespace robosim
