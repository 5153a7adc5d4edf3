#pragma once
#include <memory>
#include <string>

#include "robosim/recorded_moments.h"

namespace robosim {

/// A recording that RoboSim did not make, as far as it can be shown: the robots that its labels tell of (one, when they
/// tell of none; they look like Pioneers), where ground truth or odometry has them, with scans and ranges where the
/// observations say that the sensors sit. Nothing is known of the world. What has one time is one moment. Times are
/// those of ObservationTimes, as robosim replay tells them, unless they go back to before the first observation: then
/// they count from the earliest.
/// @throws ConfigError as RawlogReader does, or when nothing in it can be shown.
std::unique_ptr<RecordedMoments> readForeignRecording(const std::string& file);

}  // namespace robosim
