#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "run_page/page_bytes.h"

namespace robosim {

/// How far poses between two stored ones may differ from the straight line that replaces them.
struct TrackTolerance {
  std::int64_t position_mm = 1;
  std::int64_t heading_ddeg = 1;  ///< tenths of a degree
  TrackTolerance doubled() const { return {2 * position_mm, 2 * heading_ddeg}; }
};

/// Poses of a robot or an object at the moments of a run, of which those are kept that are needed to restore the others
/// by linear interpolation over time ("swinging door" compression, E. H. Bristol, 1990: the line from the last kept
/// pose passes each omitted one within the tolerance).
class PoseTrack {
 public:
  /// Resolution of kept poses.
  static constexpr double kUnit_m = 1e-3, kUnit_deg = 0.1;
  /// A time that lies further ahead of the next one is wrong.
  static constexpr std::int64_t kAhead_us = 1'000'000;

  /// A kept pose.
  struct Key {
    std::uint64_t moment;
    std::int64_t time_us;
    std::int64_t x_mm, y_mm;
    std::int64_t heading_ddeg;  ///< continued beyond ±180°, so that it can be interpolated
    std::int64_t driven_mm;     ///< since the beginning
    bool is_after_gap;          ///< the way from the last key is unknown
  };

  explicit PoseTrack(TrackTolerance tolerance = {}) : tolerance_(tolerance) {}

  /// Adds the pose of a later moment. When its time is more than kAhead_us before that of the last pose, the last one
  /// is forgotten.
  void add(std::uint64_t moment, double time_s, const mrpt::math::TPose2D& world_from_body);
  /// The way to the next pose is unknown.
  void interrupt();

  /// The kept poses, up to the last one that was added.
  std::vector<Key> keys() const;
  /// The same with a larger tolerance, which is added to that before.
  PoseTrack coarser(TrackTolerance tolerance) const;
  bool isEmpty() const { return !state_.last; }

 private:
  /// The open interval between the last key and the last pose.
  struct Slopes {
    double low, high;  ///< of values over time for which the line passes all poses in between
  };

  /// What add() changes besides appending keys.
  struct State {
    std::optional<Key> last;  ///< that was added
    Slopes x{}, y{}, heading{};
    bool is_interrupted = true;
    double driven_m = 0;
    mrpt::math::TPose2D last_pose;
  };

  void addKey(Key key);
  bool extends(const Key& key) const;
  void narrow(const Key& key);
  void restart();

  TrackTolerance tolerance_;
  std::vector<Key> keys_;
  State state_;
  State before_;                 ///< the last pose
  std::size_t keys_before_ = 0;  ///< number of keys before the last pose
};

/// Appends keys, column by column: number of keys; moments, as differences; numbers of the keys after gaps, as
/// differences; x, y, heading and, if `has_driven`, distance, as differences.
void addKeys(const std::vector<PoseTrack::Key>& keys, bool has_driven, PageBytes& bytes);

}  // namespace robosim
