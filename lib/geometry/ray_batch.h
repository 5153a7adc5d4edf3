#pragma once
#include <cstdint>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "geometry/grid_index.h"

namespace robosim {

/// Level rays of one height that start near one place, as those of a laser or of a ring of sonars. Cast together: each
/// solid nearby is held against many rays at once, the nearest solids first, rather than each ray against the solids on
/// its way. Fields lie in arrays of their own, so that the compiler turns the loops over rays into vector instructions.
class RayBatch {
 public:
  /// What `body` holds for a ray that has met nothing: lower than any body, so that nothing at the range itself is
  /// kept.
  static constexpr std::int64_t kNothing = -1;

  /// Begins a batch of `count` rays from near `center` at the height `z_m`; set() each of them next.
  void begin(const mrpt::math::TPoint2D& center, double z_m, double range_m, std::size_t count);
  /// Ray `i` leads from `origin` along the unit vector `direction`, world frame. Rays that are neighbours by direction
  /// should be neighbours here.
  void set(std::size_t i, const mrpt::math::TPoint2D& origin, const mrpt::math::TPoint2D& direction) {
    x_[i] = origin.x;
    y_[i] = origin.y;
    dx_[i] = direction.x;
    dy_[i] = direction.y;
  }
  /// Call once when all rays are set.
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
  /// Holds a solid against all rays it may meet.
  void meet(const GridItem& item, std::int64_t body);

  /// Distance [m] from the origin of ray `i` to what it met, or the range.
  double distance(std::size_t i) const { return distance_[i]; }
  std::int64_t body(std::size_t i) const { return body_[i]; }

 private:
  void meetBlock(const GridItem& item, std::int64_t body, std::size_t block);

  mrpt::math::TPoint2D center_;
  double z_m_ = 0;
  double range_m_ = 0;
  double spread_m_ = 0;  ///< farthest origin from the centre
  std::size_t size_ = 0;
  std::vector<double> x_, y_, dx_, dy_;  ///< by ray; the last one repeated up to a whole block
  std::vector<double> distance_;
  std::vector<std::int64_t> body_;
  // By block of rays: the cone that holds their directions, and how far the farthest of them still reaches.
  std::vector<double> middle_x_, middle_y_, cos_, sin_, farthest_;
  std::vector<std::int64_t> touched_;
};

}  // namespace robosim
