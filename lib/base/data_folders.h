#pragma once
#include <filesystem>
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

}  // namespace robosim
