#pragma once
#include <memory>
#include <string>

#include "viewing/recorded_moments.h"

namespace robosim {

/// A recording made by another program, as far as it can be shown. Robots are derived from observation labels (one
/// Pioneer if there are none); their poses from ground truth or odometry; scans and ranges from the sensor poses in the
/// observations. The world is unknown. Observations of equal time form one moment. Times are those of ObservationTimes,
/// as in robosim replay; if they go back to before the first observation, they are relative to the earliest.
/// @throws ConfigError as RawlogReader does, or when the recording has nothing that can be shown.
std::unique_ptr<RecordedMoments> readForeignRecording(const std::string& file);

}  // namespace robosim
