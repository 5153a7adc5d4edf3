#pragma once
#include <cstdint>
#include <vector>

#include "geometry/candidates.h"
#include "geometry/front.h"
#include "geometry/level_frame.h"
#include "geometry/rough_sectors.h"
#include "geometry/sector_pairs.h"

namespace robosim {

/// The sectors of a fan at one place in the world, asked together, as the rays of a RayBatch are cast.
class SectorBatch {
 public:
  /// What `body` holds for a sector that holds nothing: lower than any body.
  static constexpr std::int64_t kNothing = -1;

  /// Puts the sectors of a fan where its carrier is; nothing is met yet. The fan must stay while the batch is in use.
  void place(const SectorFan& fan, const LevelFrame& world_from_fan, double range_m);

  std::size_t size() const { return fan_ ? fan_->size() : 0; }
  /// About the middle of the apexes.
  const mrpt::math::TPoint2D& center() const { return center_; }
  double z() const { return z_m_; }
  /// Nothing further than this from the centre can change what is known so far [m].
  double reach() const { return farthest_m_ + spread_m_; }

  /// Sectors look all ways.
  Front front() const { return {center_, {}, spread_m_}; }

  /// Holds solids against all sectors they may reach into.
  void meet(const Candidates& candidates);
  /// Call once when all solids have been met.
  void finish() { settle(); }

  /// Distance [m] from the apex of sector `i` to the nearest point in it, or the range.
  double distance(std::size_t i) const { return distance_[i]; }
  std::int64_t body(std::size_t i) const { return body_[i]; }
  /// From the apex to that point, world frame; of no meaning where there is none.
  mrpt::math::TPoint2D towards(std::size_t i) const { return {towards_x_[i], towards_y_[i]}; }

 private:
  void settle();

  const SectorFan* fan_ = nullptr;
  mrpt::math::TPoint2D center_;
  double z_m_ = 0;
  double spread_m_ = 0;    ///< farthest apex from the centre
  double farthest_m_ = 0;  ///< of all sectors: how far they still reach
  SectorFan::Vectors apex_, axis_, left_, right_;
  std::vector<double> distance_, towards_x_, towards_y_;
  std::vector<std::int64_t> body_;
  RoughSectors rough_;
  std::vector<Candidates::Masks> holding_;
  SectorPairs pairs_;
};

}  // namespace robosim
