#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "run/outputs/run_note.h"
#include "viewing/recorded_moments.h"

namespace robosim {

/// Recordings of less bytes are read in full, which takes a second per 6 MB.
inline constexpr std::uint64_t kMinIndexedBytes = std::uint64_t{4} << 20;

/// Opens a recording made by RoboSim by the index of its rawlog (MemberIndex), which has all moments, the robots' paths
/// (TraceSampler) and their events. Steps are read when they are shown, each in constant time: from the beginning of
/// the member that contains it, or of one before it for sensors with a rate.
///
/// The objects at a step are those after the last list of all objects before it, and the comments since. Damage is
/// noticed where it is shown: then the moments end before it.
/// @return null for a recording without such an index, one of less than kMinIndexedBytes, one whose steps or robots
/// are not all of the recorded world, and one with damage in what is read first
/// @throws ConfigError when the world cannot be read
std::unique_ptr<RecordedMoments> openIndexedRecording(const std::string& file, const RunNote& note, Pictures pictures,
                                                      std::uint64_t min_bytes = kMinIndexedBytes);

}  // namespace robosim
