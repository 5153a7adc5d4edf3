#pragma once
#include <filesystem>

namespace robosim {

/// Folder of the running executable, where RoboSim's other executables and modules are.
/// @throws std::runtime_error when /proc is not mounted
std::filesystem::path programFolder();

}  // namespace robosim
