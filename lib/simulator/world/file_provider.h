#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "base/error_list.h"

namespace robosim {

/// Texts of files by name.
using FileTexts = std::map<std::string, std::string>;

/// Error for a file that cannot be read.
class UnreadableFile : public ConfigError {
 public:
  using ConfigError::ConfigError;
};

/// Source of the files that a world file refers to: the disk, or texts received with the world. Names are paths
/// relative to the world file's folder.
struct FileProvider {
  std::filesystem::path folder;  ///< of the world file
  /// @throws UnreadableFile
  std::function<std::string(const std::string& name)> read;

  /// Path of a file for error messages.
  std::string pathOf(const std::string& name) const { return (folder / name).string(); }
};

/// Maximum size [bytes] of a file that a world refers to.
constexpr std::size_t kMaxFileBytes = 256u << 20;

/// Ending of the files that a world file includes.
constexpr const char* kIncludedExtension = ".xml";

/// Provides files from disk, relative to the world file's folder. A file that is included must lie in this folder, or
/// below it, also after symbolic links are resolved.
FileProvider filesOnDisk(const std::filesystem::path& world_file);
/// Provides the given texts only. `files` must outlive the result.
FileProvider makeProvider(const std::filesystem::path& world_file, const FileTexts& files);

}  // namespace robosim
