#include "sensors/level_beams.h"

#include <algorithm>
#include <cmath>

#include "geometry/ray_batch.h"
#include "sensors/beam_mounts.h"

namespace robosim {

LevelBeams::LevelBeams(const std::vector<Beam>& beams) {
  for (const auto& beam : beams) {
    beams_.push_back({originOf(beam), directionOf(beam)});
    const double z_m = beams_.back().origin.z;
    auto tier = std::find_if(tiers_.begin(), tiers_.end(), [&](const Tier& t) { return t.z_m == z_m; });
    if (tier == tiers_.end()) tier = tiers_.insert(tier, {z_m, {}, {}});
    tier->beams.push_back(beams_.size() - 1);
  }
  for (auto& tier : tiers_) {
    for (const auto i : tier.beams) tier.middle += {beams_[i].origin.x, beams_[i].origin.y};
    tier.middle *= 1.0 / static_cast<double>(tier.beams.size());
  }
}

void LevelBeams::cast(const Snapshot& now, std::uint32_t robot, double pan_rad, double range_m,
                      std::vector<Met>& met) const {
  static thread_local RayBatch batch;  // its arrays serve all robots of a thread
  const RobotFrame& frame = now.frames[robot];
  const double pan_cos = std::cos(pan_rad);
  const double pan_sin = std::sin(pan_rad);
  met.resize(beams_.size());
  for (const auto& tier : tiers_) {
    const auto middle = frame.pointToWorld(mrpt::math::TPoint3D(tier.middle.x, tier.middle.y, tier.z_m));
    batch.begin({middle.x, middle.y}, middle.z, range_m, tier.beams.size());
    for (std::size_t k = 0; k < tier.beams.size(); ++k) {
      const std::size_t i = tier.beams[k];
      const auto origin = frame.pointToWorld(beams_[i].origin);
      const auto& ahead = beams_[i].direction;
      const mrpt::math::TPoint2D panned(pan_cos * ahead.x - pan_sin * ahead.y, pan_sin * ahead.x + pan_cos * ahead.y);
      batch.set(k, {origin.x, origin.y}, frame.turnToWorld(panned));
    }
    batch.finish();
    now.scene.castRays(batch, now.bodyOf(robot));
    for (std::size_t k = 0; k < tier.beams.size(); ++k) {
      const auto body = batch.body(k);
      met[tier.beams[k]] = {batch.distance(k),
                            body == RayBatch::kNothing ? kNoBody : BodyId(static_cast<std::uint32_t>(body))};
    }
  }
}

}  // namespace robosim
