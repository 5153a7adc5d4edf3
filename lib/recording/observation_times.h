#pragma once
#include <cstdint>
#include <optional>

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation.h>

namespace robosim {

/// From one timestamp to another [s], negative when the second is earlier. Any two may be asked for; MRPT's own
/// timeDifference() throws for one that is invalid.
double secondsBetween(mrpt::Clock::time_point from, mrpt::Clock::time_point to);

/// When the observations of a recording were made, in seconds since its first one. Anybody's recording has a time for
/// each, whatever its timestamps are: an observation without one is of the time of the one before it. Until the first
/// timestamp of all, and so to the end of a recording that has none, every entry is a step of kUntimedStep_s.
///
/// Times need not grow, nor be positive: some recordings were put together from several.
class ObservationTimes {
 public:
  static constexpr double kUntimedStep_s = 0.1;

  /// Of the next observation.
  /// @param entry RawlogReader::entries() after it was read: what came in one frame is of one time
  double of(const mrpt::obs::CObservation&, std::uint64_t entry);

 private:
  std::optional<std::uint64_t> first_entry_;
  std::optional<mrpt::Clock::time_point> first_stamp_;
  double first_stamp_s_ = 0;  ///< when that was
  double last_s_ = 0;
};

}  // namespace robosim
