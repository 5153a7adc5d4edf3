#include "recording/observation_times.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include <mrpt/obs/CObservationComment.h>
#include <mrpt/system/datetime.h>

#include "recording/rawlog_reader.h"

namespace robosim {
namespace {

/// The timestamps of the observations of one label and class.
struct StampedSource {
  std::uint64_t count = 0;
  mrpt::Clock::time_point earliest = mrpt::Clock::time_point::max(), latest = mrpt::Clock::time_point::min();

  void add(mrpt::Clock::time_point stamp) {
    ++count;
    earliest = std::min(earliest, stamp);
    latest = std::max(latest, stamp);
  }
};

/// Whether the timestamps at the beginning of a recording are too close to each other for times of measurements. Those
/// of different sources may be equal: all robots of a run measure at the same times.
bool hasLostItsTimes(const std::filesystem::path& rawlog) {
  constexpr std::uint64_t kExaminedEntries = 200;
  std::map<std::pair<std::string, std::string>, StampedSource> sources;
  RawlogReader reader(rawlog);
  if (reader.isForeign()) return false;
  while (const auto observation = reader.next()) {
    if (reader.entries() > kExaminedEntries) break;
    if (observation->timestamp == INVALID_TIMESTAMP) continue;
    sources[{observation->sensorLabel, observation->GetRuntimeClass()->className}].add(observation->timestamp);
  }
  const auto most = std::max_element(sources.begin(), sources.end(),
                                     [](const auto& a, const auto& b) { return a.second.count < b.second.count; });
  if (most == sources.end() || most->second.count < 3) return false;
  const double span_s = secondsBetween(most->second.earliest, most->second.latest);
  return span_s < ObservationTimes::kShortestPeriod_s * static_cast<double>(most->second.count - 1);
}

}  // namespace

double secondsBetween(mrpt::Clock::time_point from, mrpt::Clock::time_point to) {
  using Ticks = mrpt::Clock::duration;
  constexpr double kTicksPerSecond = static_cast<double>(Ticks::period::den) / Ticks::period::num;
  const Ticks::rep a = from.time_since_epoch().count(), b = to.time_since_epoch().count();
  Ticks::rep difference = 0;
  // A damaged file may contain any numbers.
  if (__builtin_sub_overflow(b, a, &difference))
    return (static_cast<double>(b) - static_cast<double>(a)) / kTicksPerSecond;
  return static_cast<double>(difference) / kTicksPerSecond;
}

ObservationTimes::ObservationTimes(const std::filesystem::path& rawlog)
    : counts_entries_(std::filesystem::is_regular_file(rawlog) && hasLostItsTimes(rawlog)) {}

double ObservationTimes::of(const mrpt::obs::CObservation& observation, std::uint64_t entry) {
  if (dynamic_cast<const mrpt::obs::CObservationComment*>(&observation) != nullptr) return last_s_;
  if (!first_entry_) first_entry_ = entry;
  if (counts_entries_) return static_cast<double>(entry - *first_entry_) * kUntimedStep_s;
  if (observation.timestamp == INVALID_TIMESTAMP) {
    if (!first_stamp_) last_s_ = static_cast<double>(entry - *first_entry_) * kUntimedStep_s;
    return last_s_;
  }
  if (!first_stamp_) {
    first_stamp_ = observation.timestamp;
    first_stamp_s_ = static_cast<double>(entry - *first_entry_) * kUntimedStep_s;
  }
  return last_s_ = first_stamp_s_ + secondsBetween(*first_stamp_, observation.timestamp);
}

}  // namespace robosim
