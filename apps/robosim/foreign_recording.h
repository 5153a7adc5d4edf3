#pragma once
#include <string>
#include <vector>

#include "rendering/shown.h"
#include "robots/fleet.h"

namespace robosim {

/// A recording that RoboSim did not make, as far as it can be shown: the robots that its labels tell of (one, when they
/// tell of none), where ground truth or odometry has them, with scans and ranges where the observations say that the
/// sensors sit. Nothing is known of the world.
struct ForeignRecording {
  LoadedWorld world;  ///< no objects; robots look like Pioneers
  std::vector<Shown> moments;
  std::string trouble;  ///< why the end came early; empty for a whole file
};

/// @throws ConfigError as RawlogReader does, or when nothing in it can be shown.
ForeignRecording readForeignRecording(const std::string& file);

}  // namespace robosim
