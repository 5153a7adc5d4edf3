#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "world/world.h"

namespace robosim {

/// Input files of a world: the world file, its maps with their images, and the robot type files in its search path.
std::vector<std::filesystem::path> listInputFiles(const std::string& world_file, const World& world);

/// Rejects outputs that would replace an input: equal canonical path, or the same device and inode; includes the
/// temporary name "<name>.part".
/// @throws ConfigError
void refuseOverwriting(const std::vector<std::filesystem::path>& inputs,
                       const std::vector<std::filesystem::path>& outputs);

}  // namespace robosim
