#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation.h>

namespace robosim {

/// Time from one timestamp to another [s], negative when the second is earlier. Valid for any two timestamps; MRPT's
/// timeDifference() throws for invalid ones.
double secondsBetween(mrpt::Clock::time_point from, mrpt::Clock::time_point to);

/// Computes the times of a recording's observations, in seconds since the first one. A comment, which may have been
/// added at any time, and an observation without a timestamp get the time of the previous one. Before the first
/// timestamp of a recording, each entry adds kUntimedStep_s. So does each entry of a recording that has lost its times,
/// as by a conversion that stamps all entries in an instant.
///
/// Times may decrease or be negative: some recordings are concatenations.
class ObservationTimes {
 public:
  static constexpr double kUntimedStep_s = 0.1;
  /// Entries of one source whose timestamps differ by less than this on average were not made at these times: the
  /// fastest sensors that rawlogs contain have some kHz.
  static constexpr double kShortestPeriod_s = 1e-4;

  ObservationTimes() = default;
  /// Reads the beginning of the recording to find out whether its timestamps are times. From a pipe, which can be read
  /// only once, they are taken for times.
  explicit ObservationTimes(const std::filesystem::path& rawlog);

  /// Time of the next observation.
  /// @param entry RawlogReader::entries() after it was read: the observations of one frame have the same time
  double of(const mrpt::obs::CObservation&, std::uint64_t entry);

 private:
  bool counts_entries_ = false;
  std::optional<std::uint64_t> first_entry_;
  std::optional<mrpt::Clock::time_point> first_stamp_;
  double first_stamp_s_ = 0;  ///< time of first_stamp_
  double last_s_ = 0;
};

}  // namespace robosim
