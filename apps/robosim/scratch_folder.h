#pragma once
#include <filesystem>

namespace robosim {

/// A new folder among the system's temporary ones, gone with all that is in it at the end.
class ScratchFolder {
 public:
  /// @throws std::runtime_error when there is no room for one
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace robosim
