#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace robosim {

/// Folder with the data that belong to RoboSim: worlds/, maps/ and rawlogs/. It is share/robosim of the installation:
/// the first that exists in the folder of the program or shared library that contains this function, in its parent and
/// in its grandparent. In a build tree it is a link to the source tree.
/// @throws std::runtime_error when /proc is not mounted
std::filesystem::path shareFolder();

/// A folder with a subfolder robots/.
struct WorldFolder {
  std::filesystem::path path;
  bool is_from_environment = false;  ///< from ROBOSIM_PATH
};

/// Folders searched for robot types, after the one of the world file: those in the environment variable ROBOSIM_PATH,
/// separated by colons, then worlds/ of shareFolder().
std::vector<WorldFolder> worldFolders();

/// Folders searched for input files that are not where their path says: those in ROBOSIM_PATH, then worlds/,
/// worlds/benchmark/, maps/ and rawlogs/ of shareFolder(), and shareFolder() itself.
std::vector<std::filesystem::path> dataFolders();

/// Finds an input file: the file itself or, for a relative path, below one of dataFolders(). Where the name has no
/// ending, also finds it with ".xml" appended.
/// @return nullopt if there is none
std::optional<std::filesystem::path> findDataFile(const std::filesystem::path& file);

/// findDataFile(). Of a broken link, which exists although it cannot be read, the path itself.
/// @throws ConfigError if there is none, with the folders searched
std::filesystem::path requireDataFile(const std::filesystem::path& file);

/// Names dataFolders() for an error message: "; searched are also FOLDER, … (ROBOSIM_PATH adds folders)". Empty for an
/// absolute path, for which no folder is searched.
std::string searchedText(const std::filesystem::path& file);

}  // namespace robosim
