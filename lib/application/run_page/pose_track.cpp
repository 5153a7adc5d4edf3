#include "run_page/pose_track.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace robosim {
namespace {

using mrpt::math::TPose2D;
using Key = PoseTrack::Key;

constexpr double kTwoPi = 6.283185307179586;
constexpr std::int64_t kTurn_ddeg = 3600;

std::int64_t rounded(double value) { return static_cast<std::int64_t>(std::llround(value)); }

/// The heading that is nearest to the one before, of those that differ by full turns.
std::int64_t continued(double heading_rad, std::int64_t before_ddeg) {
  const std::int64_t heading = rounded(heading_rad / kTwoPi * kTurn_ddeg);
  const auto turns = static_cast<double>(before_ddeg - heading) / kTurn_ddeg;
  return heading + rounded(turns) * kTurn_ddeg;
}

template <typename Get>
void addDifferences(const std::vector<Key>& keys, PageBytes& bytes, const Get& get) {
  std::int64_t before = 0;
  for (const auto& key : keys) {
    const auto value = static_cast<std::int64_t>(get(key));
    bytes.addSigned(value - std::exchange(before, value));
  }
}

}  // namespace

void PoseTrack::add(std::uint64_t moment, double time_s, const TPose2D& pose) {
  const std::int64_t time_us = rounded(time_s * 1e6);
  if (state_.last && time_us < state_.last->time_us - kAhead_us) {
    before_.is_interrupted |= state_.is_interrupted;
    state_ = before_;
    keys_.resize(keys_before_);
  }
  before_ = state_;
  keys_before_ = keys_.size();
  const bool is_after_gap = std::exchange(state_.is_interrupted, false);
  if (!is_after_gap) state_.driven_m += std::hypot(pose.x - state_.last_pose.x, pose.y - state_.last_pose.y);
  state_.last_pose = pose;
  addKey({moment, time_us, rounded(pose.x / kUnit_m), rounded(pose.y / kUnit_m),
          continued(pose.phi, state_.last ? state_.last->heading_ddeg : 0), rounded(state_.driven_m / kUnit_m),
          is_after_gap});
}

void PoseTrack::interrupt() { state_.is_interrupted = true; }

void PoseTrack::addKey(Key key) {
  if (!state_.last || key.is_after_gap) {
    if (state_.last && keys_.back().moment != state_.last->moment) keys_.push_back(*state_.last);
    key.is_after_gap = true;
    keys_.push_back(key);
    restart();
  } else {
    if (!extends(key)) {
      if (keys_.back().moment != state_.last->moment) keys_.push_back(*state_.last);
      restart();
    }
    narrow(key);
  }
  state_.last = key;
}

bool PoseTrack::extends(const Key& key) const {
  const Key& from = keys_.back();
  const auto duration = static_cast<double>(key.time_us - from.time_us);
  if (duration <= 0) return false;
  const auto fits = [&](std::int64_t value, std::int64_t value_from, const Slopes& slopes) {
    const double slope = static_cast<double>(value - value_from) / duration;
    return slopes.low <= slope && slope <= slopes.high;
  };
  return fits(key.x_mm, from.x_mm, state_.x) && fits(key.y_mm, from.y_mm, state_.y) &&
         fits(key.heading_ddeg, from.heading_ddeg, state_.heading);
}

void PoseTrack::narrow(const Key& key) {
  const Key& from = keys_.back();
  const auto duration = static_cast<double>(key.time_us - from.time_us);
  if (duration <= 0) return;
  const auto narrow_one = [&](std::int64_t difference, std::int64_t tolerance, Slopes& slopes) {
    slopes.low = std::max(slopes.low, static_cast<double>(difference - tolerance) / duration);
    slopes.high = std::min(slopes.high, static_cast<double>(difference + tolerance) / duration);
  };
  narrow_one(key.x_mm - from.x_mm, tolerance_.position_mm, state_.x);
  narrow_one(key.y_mm - from.y_mm, tolerance_.position_mm, state_.y);
  narrow_one(key.heading_ddeg - from.heading_ddeg, tolerance_.heading_ddeg, state_.heading);
}

void PoseTrack::restart() {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  state_.x = state_.y = state_.heading = {-kAny, kAny};
}

std::vector<Key> PoseTrack::keys() const {
  std::vector<Key> keys = keys_;
  if (state_.last && keys.back().moment != state_.last->moment) keys.push_back(*state_.last);
  return keys;
}

PoseTrack PoseTrack::coarser(TrackTolerance tolerance) const {
  PoseTrack track(tolerance);
  for (const auto& key : keys()) track.addKey(key);
  return track;
}

void addKeys(const std::vector<Key>& keys, bool has_driven, PageBytes& bytes) {
  bytes.add(keys.size());
  addDifferences(keys, bytes, [](const Key& key) { return key.moment; });
  bytes.add(static_cast<std::uint64_t>(
      std::count_if(keys.begin(), keys.end(), [](const Key& key) { return key.is_after_gap; })));
  std::size_t before = 0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i].is_after_gap) bytes.add(i - std::exchange(before, i));
  }
  addDifferences(keys, bytes, [](const Key& key) { return key.x_mm; });
  addDifferences(keys, bytes, [](const Key& key) { return key.y_mm; });
  addDifferences(keys, bytes, [](const Key& key) { return key.heading_ddeg; });
  if (has_driven) addDifferences(keys, bytes, [](const Key& key) { return key.driven_mm; });
}

}  // namespace robosim
