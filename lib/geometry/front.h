#pragma once
#include <cmath>

#include <mrpt/math/TPoint2D.h>

#include "geometry/rough_solid.h"

namespace robosim {

/// What lies ahead of a place: the half-plane on the side that it faces, and what lies no further behind than `room_m`.
struct Front {
  mrpt::math::TPoint2D of;
  mrpt::math::TPoint2D facing;  ///< unit vector; (0, 0) has everything ahead
  double room_m = 0;
};

/// The same in single precision, for one solid after another.
class RoughFront {
 public:
  /// @param middle from where the solids are seen
  RoughFront(const Front& front, const mrpt::math::TPoint2D& middle)
      : from_(RoughPlace::from(front.of, 0, middle, front.room_m)),
        facing_x_(static_cast<float>(front.facing.x)),
        facing_y_(static_cast<float>(front.facing.y)) {}

  bool mayHold(const RoughSolid& solid) const {
    const float ahead_m = facing_x_ * (solid.x - from_.x) + facing_y_ * (solid.y - from_.y);
    return ahead_m >= -(solid.half_length_m + solid.half_width_m + solid.round_m + from_.lost_m);
  }

 private:
  RoughPlace from_;
  float facing_x_, facing_y_;
};

/// What lies ahead, for the cells of a grid, in which anything may lie.
class CellsAhead {
 public:
  /// @param low the grid's lowest corner
  CellsAhead(const Front& front, const mrpt::math::TPoint2D& low, double cell_m)
      : a_column_m_(front.facing.x * cell_m), a_row_m_(front.facing.y * cell_m) {
    const double low_m = front.facing.x * (low.x - front.of.x) + front.facing.y * (low.y - front.of.y);
    first_m_ = low_m + (a_column_m_ + a_row_m_) / 2 + (std::abs(a_column_m_) + std::abs(a_row_m_)) / 2 + front.room_m +
               kSlack_m;
  }

  bool mayHold(int column, int row) const { return first_m_ + column * a_column_m_ + row * a_row_m_ >= 0; }

 private:
  static constexpr double kSlack_m = 1e-6;  ///< more than the rounding of any of these sums

  double a_column_m_, a_row_m_;  ///< how much further ahead the next column or row lies
  double first_m_;               ///< the foremost corner of the first cell, and the room
};

}  // namespace robosim
