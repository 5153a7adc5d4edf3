#pragma once
#include <string>

namespace robosim {

/// Describes the folders searched for robot types, for error messages; names the value of ROBOSIM_WORLDS if that is not
/// a folder.
std::string robotTypeFoldersText();

}  // namespace robosim
