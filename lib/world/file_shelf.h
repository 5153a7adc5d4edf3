#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "base/error_list.h"

namespace robosim {

/// Files by name.
using FileTexts = std::map<std::string, std::string>;

/// A file that cannot be had at all.
class UnreadableFile : public ConfigError {
 public:
  using ConfigError::ConfigError;
};

/// Where the files stand that a world file names: on the disk, or among what came from elsewhere. A name is a path that
/// counts from the world file's folder.
struct FileShelf {
  std::filesystem::path folder;  ///< of the world file
  /// @throws UnreadableFile
  std::function<std::string(const std::string& name)> read;

  /// How a file is named in errors.
  std::string pathOf(const std::string& name) const { return (folder / name).string(); }
};

/// Largest file read [bytes] beside a world.
constexpr std::size_t kMostShelfFileBytes = 256u << 20;

/// The files beside a world file.
FileShelf shelfOnDisk(const std::filesystem::path& world_file);
/// Those that came with it, and no others. The shelf lives no longer than `files`.
FileShelf shelfOf(const std::filesystem::path& world_file, const FileTexts& files);

}  // namespace robosim
