#pragma once
#include <cassert>
#include <vector>

#include "hardware/sensor_info.h"
#include "sensors/sensor.h"

namespace robosim {

/// Thin planar beams of one sensor, cast together.
class PlanarBeams {
 public:
  explicit PlanarBeams(const std::vector<Beam>& beams);

  std::size_t size() const { return beams_.size(); }
  /// Origin and direction of a beam, robot frame, before panning.
  const Ray& operator[](std::size_t i) const { return beams_[i]; }

  /// Casts the beams of a robot, all turned by `pan_rad`. For each height at which there are candidate solids, calls
  /// visit(i, distance_m, body) for all beams at that height: with the range and kNoBody for a beam without a hit.
  /// @return whether visit() was called
  template <typename Visit>
  bool cast(const Snapshot& now, std::uint32_t robot, double pan_rad, double range_m, const Visit& visit) const {
    static thread_local BeamBatch batch;  // reused for all robots of a thread
    bool any = false;
    for (const auto& group : groups_) {
      batch.place(group.fan, now.frames[robot], range_m, pan_rad);
      now.scene.cast(batch, now.bodyOf(robot));
      if (batch.hasNoCandidates()) continue;
      any = true;
      for (std::size_t k = 0; k < group.beams.size(); ++k) {
        static_assert(BodyId{static_cast<std::uint32_t>(BeamBatch::kNothing)} == kNoBody);
        visit(group.beams[k], batch.distance(k), BodyId{static_cast<std::uint32_t>(batch.body(k))});
      }
    }
    return any;
  }

  /// The same for all beams of a sensor at one height, each replaced by a ray in the world.
  template <typename Visit>
  void castMoved(const Snapshot& now, std::uint32_t robot, double pan_rad, double range_m, const MovedRays& moved,
                 const Visit& visit) const {
    static thread_local BeamBatch batch;
    assert(groups_.size() == 1);
    batch.placeMoved(groups_.front().fan, now.frames[robot], range_m, pan_rad, moved);
    now.scene.cast(batch, now.bodyOf(robot));
    for (std::size_t i = 0; i < beams_.size(); ++i) {
      visit(i, batch.distance(i), BodyId{static_cast<std::uint32_t>(batch.body(i))});
    }
  }

 private:
  /// Beams at one height, as a BeamFan requires.
  struct HeightGroup {
    std::vector<std::size_t> beams;
    BeamFan fan;
  };
  std::vector<Ray> beams_;
  std::vector<HeightGroup> groups_;
};

}  // namespace robosim
