#pragma once
#include <vector>

#include "hardware/sensor_info.h"
#include "sensors/sensor.h"

namespace robosim {

/// What a beam met.
struct Met {
  double distance_m = 0;  ///< from the beam's origin; the range when it met nothing
  BodyId body = kNoBody;
};

/// Thin level beams of one sensor, cast together.
class LevelBeams {
 public:
  explicit LevelBeams(const std::vector<Beam>& beams);

  std::size_t size() const { return beams_.size(); }
  /// Where a beam starts and looks, robot frame, before panning.
  const Ray& operator[](std::size_t i) const { return beams_[i]; }

  /// Replaces `met` by what each beam of a robot meets nearer than the range, all turned by `pan_rad`.
  void cast(const Snapshot& now, std::uint32_t robot, double pan_rad, double range_m, std::vector<Met>& met) const;

 private:
  /// Beams of one height: a batch of rays has one.
  struct Tier {
    double z_m;
    mrpt::math::TPoint2D middle;  ///< of their origins
    std::vector<std::size_t> beams;
  };
  std::vector<Ray> beams_;
  std::vector<Tier> tiers_;
};

}  // namespace robosim
