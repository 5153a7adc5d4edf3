#include "world/file_shelf.h"

#include "base/whole_file.h"

namespace robosim {

FileShelf shelfOnDisk(const std::filesystem::path& world_file) {
  const std::filesystem::path folder = world_file.parent_path();
  return {folder, [folder](const std::string& name) {
            try {
              return readWholeFile(folder / name, kMostShelfFileBytes, "is it a map?");
            } catch (const ConfigError& error) {
              throw UnreadableFile(error.what());
            }
          }};
}

FileShelf shelfOf(const std::filesystem::path& world_file, const FileTexts& files) {
  const std::filesystem::path folder = world_file.parent_path();
  return {folder, [folder, &files](const std::string& name) {
            const auto found = files.find(name);
            if (found == files.end()) throw UnreadableFile((folder / name).string() + ": did not come with the world");
            return found->second;
          }};
}

}  // namespace robosim
