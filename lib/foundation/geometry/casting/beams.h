#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "geometry/shapes/planar_transform.h"
#include "geometry/shapes/ray.h"
#include "geometry/shapes/sector.h"

namespace robosim {

struct BearingArrays;
struct Candidates;

/// Beams of a sensor at one height with nearby origins, in the frame of their carrier, such as those of a laser or of a
/// sonar ring. The beams are either all planar rays or all sectors. Precomputes what every BeamBatch of the fan needs.
class BeamFan {
 public:
  BeamFan() = default;
  /// @param rays planar (direction.z == 0), all with the same origin.z
  explicit BeamFan(std::span<const Ray> rays);
  /// @param sectors all with the same apex.z
  explicit BeamFan(std::span<const Sector> sectors);

  std::size_t size() const { return slot_.size(); }
  /// Place of a beam in BeamBatch::distancesBySlot().
  std::size_t slotOf(std::size_t i) const { return slot_[i]; }

 private:
  friend class BeamBatch;

  bool is_wide_ = false;  ///< whether the beams are sectors
  double z_m_ = 0;
  mrpt::math::TPoint2D middle_;  ///< of the beams' origins
  double spread_m_ = 0;          ///< from the middle to the farthest origin
  mrpt::math::TPoint2D facing_;  ///< unit vector within 90° of all directions in the beams; (0, 0) when there is none
  std::size_t padded_ = 0;       ///< number of beams, in whole blocks
  /// By slot, the beams sorted counter-clockwise, padded with the last one: x and y of their origins, of their left
  /// edges and of their right edges, one array after the other. A ray has its direction as both edges.
  std::vector<double> fields_;
  std::vector<std::uint32_t> slot_;  ///< by beam
  std::size_t block_ = 0;            ///< beams that are intersected with a solid together
  float half_width_rad_ = 0;         ///< of the widest beam
  /// By bin of BearingArrays, over two turns, and the end: the first slot at or after the bin's begin. The slots of the
  /// second turn begin at the padded number of beams.
  std::vector<std::uint32_t> first_;
};

/// Rays of a fan's beams that start from other poses than the batch's, such as those of a scanner that moves during a
/// scan.
struct MovedRays {
  std::span<const Ray> rays;  ///< by beam, world frame; planar, at the height of the fan
  double shift_m = 0;         ///< at least the distance of each ray's origin from that of the beam at the batch's pose
  double turn_rad = 0;        ///< at least the angle between each ray and the beam at the batch's pose; at most 1
};

/// Beams of a fan at one pose in the world, cast together by Scene::cast(). May be reused for many fans and poses.
class BeamBatch {
 public:
  BeamBatch();
  ~BeamBatch();
  BeamBatch(const BeamBatch&) = delete;
  BeamBatch& operator=(const BeamBatch&) = delete;

  /// Value of body() for a beam without a hit. Lower than any body, so that a hit exactly at the range is not kept.
  static constexpr std::int64_t kNothing = -1;

  /// Places the beams of a fan at its carrier's pose, all turned about their own origins by `pan_rad` first, without
  /// any hit. The fan must outlive the use of the batch.
  void place(const BeamFan& fan, const PlanarTransform& world_from_fan, double range_m, double pan_rad = 0);
  /// The same for a fan of rays, with each ray replaced. The rays must outlive the use of the batch.
  void placeMoved(const BeamFan& fan, const PlanarTransform& world_from_fan, double range_m, double pan_rad,
                  const MovedRays& moved);

  std::size_t size() const { return fan_ ? fan_->size() : 0; }
  /// Whether Scene::cast() found no solid that the beams may hit.
  bool hasNoCandidates() const { return !is_initialized_; }
  /// Distance [m] from the origin of beam `i` to its hit, or the range.
  double distance(std::size_t i) const {
    return is_initialized_ ? field(Field::distance)[fan_->slot_[i]] : farthest_m_;
  }
  /// The same of all beams, sorted by bearing (BeamFan::slotOf()), then unused ones; undefined if hasNoCandidates().
  std::span<const double> distancesBySlot() const { return {field(Field::distance), fan_->padded_}; }
  std::int64_t body(std::size_t i) const {
    return is_initialized_ ? static_cast<std::int64_t>(field(Field::body)[fan_->slot_[i]]) : kNothing;
  }
  /// Vector from the origin of sector `i` to its nearest point, world frame; undefined without a hit and for rays.
  mrpt::math::TPoint2D towards(std::size_t i) const {
    const std::size_t slot = fan_->slot_[i];
    return {field(Field::towards_x)[slot], field(Field::towards_y)[slot]};
  }

 private:
  friend class Scene;

  /// By slot, as in the fan, one array after the other. A body is a double, so that it is compared in the same vectors
  /// as distances.
  enum class Field : std::uint8_t {
    x,
    y,
    left_x,
    left_y,
    right_x,
    right_y,
    distance,
    body,
    towards_x,
    towards_y,
    count
  };
  const double* field(Field which) const { return fields_.data() + static_cast<std::size_t>(which) * fan_->padded_; }
  double* field(Field which) { return fields_.data() + static_cast<std::size_t>(which) * fan_->padded_; }

  /// Distance [m] from the centre beyond which no solid can change the result.
  double reach() const { return farthest_m_ + spread_m_; }
  /// Intersects solids with all beams that may hit them.
  void intersect(Candidates& candidates);
  /// Computes the beams in the world. Deferred until the first intersect(), because most short-range sensors have no
  /// candidates.
  void initialize();

  const BeamFan* fan_ = nullptr;
  std::span<const Ray> moved_;  ///< empty: all beams at the pose below
  double turned_rad_ = 0;       ///< MovedRays::turn_rad
  PlanarTransform world_from_fan_;
  PlanarTransform panned_;  ///< world_from_fan_, turned by the pan angle
  bool is_initialized_ = false;
  mrpt::math::TPoint2D center_;  ///< approximate middle of the beams' origins
  mrpt::math::TPoint2D facing_;  ///< of the fan, world frame
  double z_m_ = 0;
  double spread_m_ = 0;    ///< farthest origin from the centre
  double farthest_m_ = 0;  ///< the largest current distance of all beams
  std::vector<double> fields_;
  std::unique_ptr<BearingArrays> arrays_;  ///< memory of intersect()
};

}  // namespace robosim
