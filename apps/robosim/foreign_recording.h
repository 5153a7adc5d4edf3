#pragma once
#include <string>
#include <vector>

#include "rendering/shown.h"
#include "robots/fleet.h"

namespace robosim {

/// A recording that RoboSim did not make, as far as it can be shown: the robots that its labels tell of (one, when they
/// tell of none), where ground truth or odometry has them, with scans and ranges where the observations say that the
/// sensors sit. Nothing is known of the world. What was made without a time has that of the observation before it; a
/// recording without any times goes on by 0.1 s an entry.
struct ForeignRecording {
  LoadedWorld world;           ///< no objects; robots look like Pioneers
  std::vector<Shown> moments;  ///< in the order of time, which begins at 0 s; each has every robot
  std::string trouble;         ///< why the end came early, and what was left out; empty for a whole file
};

/// @throws ConfigError as RawlogReader does, or when nothing in it can be shown.
ForeignRecording readForeignRecording(const std::string& file);

}  // namespace robosim
