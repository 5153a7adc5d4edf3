#include "base/data_folders.h"

#include <cstdlib>
#include <sstream>

#include <dlfcn.h>
#include <link.h>

#include "base/error_list.h"
#include "base/program_folder.h"

namespace robosim {

namespace {

namespace fs = std::filesystem;

/// Folder of the program or shared library that contains this code. An interpreter that loads the library is elsewhere.
fs::path folderOfThisCode() {
  Dl_info info;
  link_map* object = nullptr;
  const auto* here = reinterpret_cast<const void*>(&shareFolder);
  const bool is_found = dladdr1(here, &info, reinterpret_cast<void**>(&object), RTLD_DL_LINKMAP) != 0;
  // The main program has no name here.
  if (!is_found || !object || !object->l_name || !*object->l_name) return programFolder();
  std::error_code none;
  const fs::path file = fs::canonical(object->l_name, none);
  return none ? programFolder() : file.parent_path();
}

}  // namespace

std::filesystem::path shareFolder() {
  const fs::path folder = folderOfThisCode();
  for (const fs::path& prefix : {folder, folder.parent_path(), folder.parent_path().parent_path()}) {
    std::error_code none;
    if (fs::is_directory(prefix / "share" / "robosim", none)) return prefix / "share" / "robosim";
  }
  return folder.parent_path() / "share" / "robosim";
}

std::vector<fs::path> dataFolders() {
  std::vector<fs::path> folders;
  for (const auto& folder : worldFolders()) {
    if (folder.is_from_environment) folders.push_back(folder.path);
  }
  const fs::path share = shareFolder();
  for (const char* kind : {"worlds", "worlds/benchmark", "maps", "rawlogs"}) folders.push_back(share / kind);
  folders.push_back(share);
  return folders;
}

std::optional<fs::path> findDataFile(const fs::path& file) {
  std::vector<fs::path> names{file};
  if (file.has_filename() && !file.has_extension()) names.emplace_back(file.string() + ".xml");
  std::vector<fs::path> folders{""};
  if (file.is_relative()) {
    for (auto& folder : dataFolders()) folders.push_back(std::move(folder));
  }
  for (const auto& folder : folders) {
    for (const auto& name : names) {
      std::error_code none;
      const fs::file_status status = fs::status(folder / name, none);
      if (fs::exists(status) && !fs::is_directory(status)) return folder / name;
    }
  }
  return std::nullopt;
}

fs::path requireDataFile(const fs::path& file) {
  if (auto found = findDataFile(file)) return *std::move(found);
  std::error_code none;
  if (fs::exists(fs::symlink_status(file, none))) return file;
  throw ConfigError(file.string() + ": no such file; check the path" + searchedText(file));
}

std::string searchedText(const fs::path& file) {
  if (file.is_absolute()) return "";
  std::vector<std::string> folders;
  for (const auto& folder : dataFolders()) folders.push_back(folder.string());
  return "; searched are also " + listed(folders) + " (ROBOSIM_PATH adds folders)";
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
