#pragma once
#include <string>

namespace robosim {

/// Describes the folders searched for robot types, for error messages: which do not exist, and which ROBOSIM_PATH
/// names.
std::string robotTypeFoldersText();

}  // namespace robosim
