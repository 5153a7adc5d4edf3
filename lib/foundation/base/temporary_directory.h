#pragma once
#include <filesystem>

namespace robosim {

/// A new folder in the system's temporary folder; the destructor removes it with its content.
class TemporaryDirectory {
 public:
  /// @throws std::runtime_error when the folder cannot be created
  TemporaryDirectory();
  /// A folder in a memory file system where there is one, so that a benchmark does not measure the disk.
  static TemporaryDirectory inMemory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

 private:
  explicit TemporaryDirectory(const std::filesystem::path& parent);

  std::filesystem::path path_;
};

}  // namespace robosim
