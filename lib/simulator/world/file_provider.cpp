#include "world/file_provider.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/input_file.h"
#include "base/xml_element.h"
#include "world/caching_file_provider.h"

namespace robosim {
namespace {

/// @throws UnreadableFile
void checkIsWithin(const std::filesystem::path& folder, const std::string& name) {
  std::error_code none;
  const auto real_folder = std::filesystem::weakly_canonical(folder.empty() ? "." : folder, none);
  const auto real_file = std::filesystem::weakly_canonical(folder / name, none);
  const auto beyond = std::mismatch(real_folder.begin(), real_folder.end(), real_file.begin(), real_file.end());
  if (beyond.first == real_folder.end()) return;
  throw UnreadableFile((folder / name).string() + ": is a link to a file outside the world's folder; copy the file");
}

}  // namespace

FileProvider filesOnDisk(const std::filesystem::path& world_file) {
  const std::filesystem::path folder = world_file.parent_path();
  return {folder, [folder](const std::string& name) {
            const bool is_included = std::filesystem::path(name).extension() == kIncludedExtension;
            if (is_included) checkIsWithin(folder, name);
            try {
              if (is_included) return readWholeFile(folder / name, kMaxXmlFileBytes, "is it a part of a world?");
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

FileProvider makeProvider(const std::filesystem::path& world_file, const FileTexts& files) {
  const std::filesystem::path folder = world_file.parent_path();
  return {folder, [folder, &files](const std::string& name) {
            const auto found = files.find(name);
            if (found == files.end()) throw UnreadableFile((folder / name).string() + ": did not come with the world");
            return found->second;
          }};
}

}  // namespace robosim
