#pragma once
#include <cstdint>
#include <vector>

#include "geometry/casting/beam_fan.h"
#include "geometry/casting/candidates.h"
#include "geometry/index/culling.h"
#include "geometry/shapes/planar_transform.h"

namespace robosim {

/// Beams of a fan at one pose in the world, cast together: each nearby solid is intersected with all beams at its
/// bearing, nearest solids first.
class BeamBatch {
 public:
  /// Value of body() for a beam without a hit. Lower than any body, so that a hit exactly at the range is not kept.
  static constexpr std::int64_t kNothing = -1;

  /// Places the beams of a fan at its carrier's pose, all turned about their own origins by `pan_rad` first, without
  /// any hit. The fan must outlive the use of the batch.
  void place(const BeamFan& fan, const PlanarTransform& world_from_fan, double range_m, double pan_rad = 0);

  std::size_t size() const { return fan_ ? fan_->size() : 0; }
  /// Approximate middle of the beams' origins.
  const mrpt::math::TPoint2D& center() const { return center_; }
  double z() const { return z_m_; }
  /// Distance [m] from the centre beyond which no solid can change the result.
  double reach() const { return farthest_m_ + spread_m_; }
  /// Half-plane that contains all beams.
  HalfPlaneCull halfPlane() const { return {center_, facing_, spread_m_}; }

  /// Whether a solid reaches into that half-plane. Conservative: no false negatives.
  bool mayHit(const GridItem& item) const {
    const double ahead_m = facing_.x * (item.x - center_.x) + facing_.y * (item.y - center_.y);
    return ahead_m >= -(item.half_length_m + item.half_width_m + item.round_m + spread_m_);
  }

  /// Intersects solids with all beams that may hit them.
  void intersect(const Candidates& candidates);

  /// Whether intersect() was never called.
  bool hasNoCandidates() const { return !is_initialized_; }
  /// Distance [m] from the origin of beam `i` to its hit, or the range.
  double distance(std::size_t i) const { return is_initialized_ ? distance_[fan_->slot_[i]] : farthest_m_; }
  std::int64_t body(std::size_t i) const {
    return is_initialized_ ? static_cast<std::int64_t>(body_[fan_->slot_[i]]) : kNothing;
  }
  /// Vector from the origin of sector `i` to its nearest point, world frame; undefined without a hit and for rays.
  mrpt::math::TPoint2D towards(std::size_t i) const { return {towards_.x[fan_->slot_[i]], towards_.y[fan_->slot_[i]]}; }

 private:
  /// Computes the beams in the world. Deferred until the first intersect(), because most short-range sensors have no
  /// candidates.
  void initialize();

  const BeamFan* fan_ = nullptr;
  PlanarTransform world_from_fan_;
  PlanarTransform panned_;  ///< world_from_fan_, turned by the pan angle
  bool is_initialized_ = false;
  mrpt::math::TPoint2D center_;
  mrpt::math::TPoint2D facing_;  ///< of the fan, world frame
  double z_m_ = 0;
  double spread_m_ = 0;    ///< farthest origin from the centre
  double farthest_m_ = 0;  ///< the largest current distance of all beams
  // By slot, as in the fan. A body is a double, so that it is compared in the same vectors as distances.
  BeamFan::Vectors origin_, left_, right_;
  std::vector<double> distance_, body_;
  BeamFan::Vectors towards_;
};

}  // namespace robosim
