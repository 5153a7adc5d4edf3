#include "base/data_folders.h"

#include <cstdlib>
#include <sstream>

#include "base/program_folder.h"

namespace robosim {

std::filesystem::path shareFolder() {
  const std::filesystem::path prefix = programFolder().parent_path();
  const std::filesystem::path share = prefix / "share" / "robosim";
  std::error_code none;
  return std::filesystem::is_directory(share, none) ? share : prefix.parent_path() / "share" / "robosim";
}

std::vector<WorldFolder> worldFolders() {
  std::vector<WorldFolder> folders;
  if (const char* path = std::getenv("ROBOSIM_PATH")) {
    std::istringstream parts(path);
    for (std::string part; std::getline(parts, part, ':');) {
      if (!part.empty()) folders.push_back({part, true});
    }
  }
  folders.push_back({shareFolder() / "worlds"});
  return folders;
}

}  // namespace robosim
