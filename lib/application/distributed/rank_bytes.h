#pragma once
#include <functional>
#include <string_view>

#include "environment/state_stream.h"

namespace robosim {

/// Reads all bytes that another rank has sent; nothing if there are none. Ranks trust the values of each other: as in
/// one process, a sensor of a plugin may measure any number.
/// @param what they are, for the error
/// @throws std::runtime_error when `read` throws InvalidContents or leaves bytes, as it does for those of another
/// version of RoboSim
void readRankBytes(std::string_view bytes, const char* what, const std::function<void(StateReader&)>& read);

}  // namespace robosim
