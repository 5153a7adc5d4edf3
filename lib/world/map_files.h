#pragma once
#include <filesystem>
#include <vector>

namespace robosim {

/// The regular files that a map consists of: its own, and the picture that the .yaml of a ROS map refers to.
std::vector<std::filesystem::path> filesOfMap(const std::filesystem::path& map);

}  // namespace robosim
