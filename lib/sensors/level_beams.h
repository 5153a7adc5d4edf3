#pragma once
#include <vector>

#include "geometry/ray_batch.h"
#include "hardware/sensor_info.h"
#include "sensors/sensor.h"

namespace robosim {

/// Thin level beams of one sensor, cast together.
class LevelBeams {
 public:
  explicit LevelBeams(const std::vector<Beam>& beams);

  std::size_t size() const { return beams_.size(); }
  /// Where a beam starts and looks, robot frame, before panning.
  const Ray& operator[](std::size_t i) const { return beams_[i]; }

  /// Casts each beam of a robot, all turned by `pan_rad`, and calls visit(i, distance_m, body) for all beams of a
  /// height where anything is near: with the range and kNoBody for a beam that meets nothing.
  /// @return whether anything is near any beam
  template <typename Visit>
  bool cast(const Snapshot& now, std::uint32_t robot, double pan_rad, double range_m, const Visit& visit) const {
    static thread_local RayBatch batch;  // its arrays serve all robots of a thread
    bool any = false;
    for (const auto& tier : tiers_) {
      batch.place(tier.fan, now.frames[robot], range_m, pan_rad);
      now.scene.castRays(batch, now.bodyOf(robot), now.near[robot]);
      if (batch.isUntouched()) continue;
      any = true;
      for (std::size_t k = 0; k < tier.beams.size(); ++k) {
        static_assert(BodyId{static_cast<std::uint32_t>(RayBatch::kNothing)} == kNoBody);
        visit(tier.beams[k], batch.distance(k), BodyId{static_cast<std::uint32_t>(batch.body(k))});
      }
    }
    return any;
  }

 private:
  /// Beams of one height: a fan of rays has one.
  struct Tier {
    std::vector<std::size_t> beams;
    RayFan fan;
  };
  std::vector<Ray> beams_;
  std::vector<Tier> tiers_;
};

}  // namespace robosim
