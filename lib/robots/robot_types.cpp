#include "robots/robot_types.h"

#include <cstdlib>

#include "robots/robot_type_folders_text.h"

namespace robosim {
namespace {

std::filesystem::path worldsFolder() {
  const char* instead = std::getenv("ROBOSIM_WORLDS");
  return instead && *instead ? instead : ROBOSIM_WORLDS_DIR;
}

}  // namespace

std::vector<std::filesystem::path> robotTypeFolders(const std::filesystem::path& world_file) {
  return {world_file.parent_path() / "robots", worldsFolder() / "robots"};
}

std::string robotTypeFoldersText() {
  std::string text = "robot types are the *.xml files in robots/ beside the world file and in robots/ of ";
  const auto worlds = worldsFolder();
  std::error_code none;
  const bool is_there = std::filesystem::is_directory(worlds, none);
  const bool is_given = worlds != std::filesystem::path(ROBOSIM_WORLDS_DIR);
  return text + worlds.string() + (is_there ? "" : ", which does not exist") + (is_given ? " (ROBOSIM_WORLDS)" : "");
}

RobotTypes robotTypesIn(const std::vector<std::filesystem::path>& folders) {
  RobotTypes types;
  for (const auto& folder : folders) {
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
      const auto& file = entry.path();
      if (file.extension() == ".xml") types.try_emplace(file.stem().string(), RobotTypeFile{file, std::nullopt});
    }
  }
  return types;
}

}  // namespace robosim
