#include "world/file_provider.h"

#include <memory>
#include <utility>

#include "base/input_file.h"
#include "world/caching_file_provider.h"

namespace robosim {

FileProvider filesOnDisk(const std::filesystem::path& world_file) {
  const std::filesystem::path folder = world_file.parent_path();
  return {folder, [folder](const std::string& name) {
            try {
              return readWholeFile(folder / name, kMaxFileBytes, "is it a map?");
            } catch (const ConfigError& error) {
              throw UnreadableFile(error.what());
            }
          }};
}

FileProvider cachingFileProvider(FileProvider files) {
  const auto texts = std::make_shared<FileTexts>();
  const auto folder = files.folder;
  return {folder, [files = std::move(files), texts](const std::string& name) {
            const auto found = texts->find(name);
            return found != texts->end() ? found->second : (*texts)[name] = files.read(name);
          }};
}

FileProvider providerOf(const std::filesystem::path& world_file, const FileTexts& files) {
  const std::filesystem::path folder = world_file.parent_path();
  return {folder, [folder, &files](const std::string& name) {
            const auto found = files.find(name);
            if (found == files.end()) throw UnreadableFile((folder / name).string() + ": did not come with the world");
            return found->second;
          }};
}

}  // namespace robosim
