#include "robots/robot_types.h"

#include "base/data_folders.h"
#include "robots/robot_type_folders_text.h"

namespace robosim {

std::vector<std::filesystem::path> robotTypeFolders(const std::filesystem::path& world_file) {
  std::vector<std::filesystem::path> folders{world_file.parent_path() / "robots"};
  for (const auto& folder : worldFolders()) folders.push_back(folder.path / "robots");
  return folders;
}

std::string robotTypeFoldersText() {
  std::string text = "robot types are the *.xml files in robots/ beside the world file";
  const auto folders = worldFolders();
  for (std::size_t i = 0; i < folders.size(); ++i) {
    const std::filesystem::path path = folders[i].path / "robots";
    std::error_code none;
    text += (i + 1 < folders.size() ? ", in " : " and in ") + path.string();
    if (!std::filesystem::is_directory(path, none)) text += ", which does not exist";
    if (folders[i].is_from_environment) text += " (ROBOSIM_PATH)";
  }
  return text;
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
