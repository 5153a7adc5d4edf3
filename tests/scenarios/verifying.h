#pragma once
#include <cstdlib>

namespace robosim {

/// Whether tests run in their long variants, as in ./dev verify (`ROBOSIM_VERIFY=1`).
inline bool isVerifying() { return std::getenv("ROBOSIM_VERIFY") != nullptr; }

}  // namespace robosim
