#include "recording/range_imprint.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

#include <mrpt/core/Clock.h>

#include "recording/byte_archive.h"

namespace robosim {
namespace {

using mrpt::obs::CObservationRange;

std::vector<std::uint8_t> serialised(const CObservationRange& range) {
  ByteArchive archive;
  archive << range;
  return std::move(archive.bytes);
}

/// Where `after` differs from `before`: the one place where it holds `value`.
template <typename Value>
std::size_t placeOf(const Value& value, const std::vector<std::uint8_t>& before,
                    const std::vector<std::uint8_t>& after) {
  const auto first = std::mismatch(before.begin(), before.end(), after.begin(), after.end());
  const auto at = static_cast<std::size_t>(first.second - after.begin());
  if (before.size() != after.size() || at + sizeof value > after.size() ||
      std::memcmp(&after[at], &value, sizeof value) != 0 ||
      !std::equal(before.begin() + static_cast<std::ptrdiff_t>(at + sizeof value), before.end(),
                  after.begin() + static_cast<std::ptrdiff_t>(at + sizeof value))) {
    throw std::logic_error("this MRPT does not write the numbers of a CObservationRange as they lie in memory");
  }
  return at;
}

}  // namespace

RangeImprint::RangeImprint(const CObservationRange& range) {
  for (const auto& sensed : range) poses_.push_back(sensed.sensorPose);
  CObservationRange like = range;
  // Of a blank and a marked number every byte differs, so that the two writings differ from its first byte to its last.
  const auto blank_m = std::bit_cast<float>(0x11111111);
  const auto marked_m = std::bit_cast<float>(0x22222222);
  const auto time = [](std::int64_t ticks) { return mrpt::Clock::time_point(mrpt::Clock::duration(ticks)); };
  const auto blank_time = time(0x1111111111111111);
  const auto marked_time = time(0x2222222222222222);

  like.timestamp = blank_time;
  for (auto& sensed : like.sensedData) sensed.sensedDistance = blank_m;
  bytes_ = serialised(like);
  like.timestamp = marked_time;
  timestamp_at_ = placeOf(marked_time.time_since_epoch().count(), bytes_, serialised(like));
  like.timestamp = blank_time;
  for (auto& sensed : like.sensedData) {
    sensed.sensedDistance = marked_m;
    range_at_.push_back(placeOf(marked_m, bytes_, serialised(like)));
    sensed.sensedDistance = blank_m;
  }
}

void RangeImprint::append(const CObservationRange& range, ByteArchive& archive) {
  const auto same_pose = [](const auto& sensed, const auto& pose) { return sensed.sensorPose == pose; };
  if (!std::equal(range.begin(), range.end(), poses_.begin(), poses_.end(), same_pose)) {
    archive << range;
    return;
  }
  const auto ticks = range.timestamp.time_since_epoch().count();
  std::memcpy(&bytes_[timestamp_at_], &ticks, sizeof ticks);
  for (std::size_t i = 0; i < range_at_.size(); ++i) {
    std::memcpy(&bytes_[range_at_[i]], &range.sensedData[i].sensedDistance, sizeof(float));
  }
  archive.bytes.insert(archive.bytes.end(), bytes_.begin(), bytes_.end());
}

}  // namespace robosim
