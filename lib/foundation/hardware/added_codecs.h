#pragma once
#include <vector>

namespace robosim {

class Codec;  // recording/codec.h

/// Codecs from outside RoboSim, the latest first, which `recording` tries before its own. A list in a lower module, so
/// that programs that do not record need not load recording's libraries.
std::vector<const Codec*>& addedCodecs();

}  // namespace robosim
