#pragma once
#include <cstdint>
#include <vector>

#include "geometry/grid_index.h"
#include "geometry/sector.h"

namespace robosim {

/// Sectors of one height that look from near one place, as those of a ring of sonars. Asked together, as the rays of a
/// RayBatch are cast: each solid nearby is held against all of them at once, in loops that become vector instructions.
class SectorBatch {
 public:
  /// What `body` holds for a sector that holds nothing: lower than any body.
  static constexpr std::int64_t kNothing = -1;

  /// Begins a batch of `count` sectors from near `center` at the height `z_m`; set() each of them next.
  void begin(const mrpt::math::TPoint2D& center, double z_m, double range_m, std::size_t count);
  void set(std::size_t i, const Sector& sector);
  /// Call once when all sectors are set.
  void finish();

  std::size_t size() const { return size_; }
  const mrpt::math::TPoint2D& center() const { return center_; }
  double z() const { return z_m_; }
  /// Nothing further than this from the centre can change what is known so far [m].
  double reach() const;

  /// Whether the solid is at their height and within their range, so that meet() is worth its while.
  bool mayMeet(const GridItem& item) const {
    const double ox = item.x - center_.x;
    const double oy = item.y - center_.y;
    const double far = range_m_ + spread_m_ + item.reach_m;
    return ox * ox + oy * oy <= far * far && item.heights.contains(z_m_);
  }
  /// Holds a solid against all sectors.
  void meet(const GridItem& item, std::int64_t body);

  /// Distance [m] from the apex of sector `i` to the nearest point in it, or the range.
  double distance(std::size_t i) const { return distance_[i]; }
  std::int64_t body(std::size_t i) const { return body_[i]; }
  /// From the apex to that point, world frame; of no meaning where there is none.
  mrpt::math::TPoint2D towards(std::size_t i) const { return {towards_x_[i], towards_y_[i]}; }

 private:
  mrpt::math::TPoint2D center_;
  double z_m_ = 0;
  double range_m_ = 0;
  double spread_m_ = 0;  ///< farthest apex from the centre
  std::size_t size_ = 0;
  std::vector<double> x_, y_, left_x_, left_y_, right_x_,
      right_y_;  ///< by sector; the last one repeated to a whole block
  std::vector<double> distance_, towards_x_, towards_y_;
  std::vector<std::int64_t> body_;
};

}  // namespace robosim
