#pragma once
#include <cstdint>
#include <vector>

#include "geometry/candidates.h"
#include "geometry/front.h"
#include "geometry/level_frame.h"
#include "geometry/ray_fan.h"
#include "geometry/ray_pairs.h"

namespace robosim {

/// The rays of a fan at one place in the world, cast together: each solid nearby is held against all of them, the
/// nearest solids first, rather than each ray against the solids on its way. Fields lie in arrays of their own, so that
/// the compiler turns the loops over rays into vector instructions.
class RayBatch {
 public:
  /// What `body` holds for a ray that has met nothing: lower than any body, so that nothing at the range itself is
  /// kept.
  static constexpr std::int64_t kNothing = -1;

  /// Puts the rays of a fan where its carrier is, all turned about their own origins by `pan_rad` first. Nothing is
  /// met yet. The fan must stay while the batch is in use.
  void place(const RayFan& fan, const LevelFrame& world_from_fan, double range_m, double pan_rad = 0);

  std::size_t size() const { return fan_ ? fan_->size() : 0; }
  /// About the middle of the rays' origins.
  const mrpt::math::TPoint2D& center() const { return center_; }
  double z() const { return z_m_; }
  /// Nothing further than this from the centre can change what is known so far [m].
  double reach() const { return farthest_m_ + spread_m_; }

  /// No ray goes anywhere else.
  Front front() const;

  /// Holds solids against all rays they may meet.
  void meet(const Candidates& candidates);
  /// Call once when all solids have been met.
  void finish() {
    if (is_laid_out_ && !fan_->isSweep()) settle();
  }

  /// Whether there was nothing to hold against any ray.
  bool isUntouched() const { return !is_laid_out_; }
  /// Distance [m] from the origin of ray `i` to what it met, or the range.
  double distance(std::size_t i) const { return is_laid_out_ ? distance_[i] : farthest_m_; }
  std::int64_t body(std::size_t i) const { return is_laid_out_ ? body_[i] : kNothing; }

 private:
  /// Works out where each ray is; put off until there is something to meet, for most short-sighted sensors meet
  /// nothing.
  void layOut();
  void meetByRay(const Candidates& candidates);
  void meetByBearing(const Candidates& candidates);
  void settle();

  const RayFan* fan_ = nullptr;
  LevelFrame world_from_fan_;
  double pan_rad_ = 0;
  bool is_laid_out_ = false;
  mrpt::math::TPoint2D center_;
  double z_m_ = 0;
  double spread_m_ = 0;                  ///< farthest origin from the centre
  double farthest_m_ = 0;                ///< of all rays: how far they still reach
  std::vector<double> x_, y_, dx_, dy_;  ///< by ray, as in the fan
  std::vector<double> distance_;
  std::vector<std::int64_t> body_;

  // Of a fan that is no sweep.
  std::vector<float> rough_x_, rough_y_, rough_dx_, rough_dy_, rough_distance_;  ///< by ray, as seen from the centre
  std::vector<Candidates::Masks> passing_;  ///< by block: which of its rays candidates pass
  RayPairs pairs_;
};

}  // namespace robosim
