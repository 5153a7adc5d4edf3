#pragma once
#include <cassert>
#include <cstdint>
#include <span>
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

  std::span<const Ray> rays() const { return beams_; }

  /// Beams at one height, as a BeamFan requires.
  struct HeightGroup {
    std::vector<std::size_t> beams;
    BeamFan fan;
    std::vector<std::uint32_t> beam_of_slot;  ///< BeamFan::slotOf() of `beams`, reversed
  };
  const std::vector<HeightGroup>& groups() const { return groups_; }

  /// Casts the beams of a robot, all turned by `pan_rad`. Calls visit(group index, batch) for each height.
  /// @param batch memory, reused for all robots of a thread
  template <typename Visit>
  void castGroups(const Snapshot& now, std::uint32_t robot, double pan_rad, double range_m, BeamBatch& batch,
                  const Visit& visit) const {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      batch.place(groups_[g].fan, now.frames[robot], range_m, pan_rad);
      now.scene.cast(batch, now.bodyOf(robot));
      visit(g, static_cast<const BeamBatch&>(batch));
    }
  }

  /// The same by beam. For each height at which there are candidate solids, calls
  /// visit(i, distance_m, body) for all beams at that height: with the range and kNoBody for a beam without a hit.
  /// @return whether visit() was called
  template <typename Visit>
  bool cast(const Snapshot& now, std::uint32_t robot, double pan_rad, double range_m, const Visit& visit) const {
    static thread_local BeamBatch reused;
    bool any = false;
    castGroups(now, robot, pan_rad, range_m, reused, [&](std::size_t g, const BeamBatch& batch) {
      if (batch.hasNoCandidates()) return;
      any = true;
      const auto& beams = groups_[g].beams;
      for (std::size_t k = 0; k < beams.size(); ++k) {
        static_assert(BodyId{static_cast<std::uint32_t>(BeamBatch::kNothing)} == kNoBody);
        visit(beams[k], batch.distance(k), BodyId{static_cast<std::uint32_t>(batch.body(k))});
      }
    });
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
  std::vector<Ray> beams_;
  std::vector<HeightGroup> groups_;
};

}  // namespace robosim
