#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "geometry/index/grid_index.h"

namespace robosim {

/// Verlet list of the stationary solids near a moving owner, kept from step to step (Verlet, "Computer 'Experiments' on
/// Classical Fluids", Physical Review 159, 1967). It covers the owner's reach plus a skin and stays valid until the
/// owner has crossed the skin; until then no search is needed. Small, because a run may have very many robots.
class NeighbourList {
 public:
  /// Rebuilds the list, if the owner has crossed the skin, so that it covers the solids within `reach_m` of a point, or
  /// the nearest ones if there are very many.
  void update(const GridIndex& solids, const mrpt::math::TPoint2D& at, double reach_m);

  std::size_t size() const { return size_; }
  /// A solid near the owner.
  struct Neighbour {
    float nearest_m;      ///< distance from the anchor to the solid's outline, rounded down
    std::uint32_t solid;  ///< index into GridIndex::items()
  };
  std::span<const Neighbour> nearestFirst() const { return {nearest_first_.get(), size_}; }
  /// Distance [m] from the anchor, the point from which distances are measured, to another; infinite for an empty list.
  double driftTo(const mrpt::math::TPoint2D& p) const {
    return covered_m_ < 0 ? std::numeric_limits<double>::infinity() : (p - anchor_).norm() + kSlack_m;
  }
  /// Upper bound of Neighbour::nearest_m of the solids within a distance of the anchor.
  static float limitOf(double distance_m) {
    return static_cast<float>(distance_m * (1 + 1e-7));  // the product rounds up what the conversion may round down
  }
  /// Whether the list has all solids within a distance of the anchor.
  bool covers(double distance_m) const { return distance_m <= static_cast<double>(covered_m_); }

  /// Calls visit(index) for the solids that may lie within `reach_m` of `from`, nearest first.
  /// @return whether there are no further ones
  template <typename Visit>
  bool visitNear(const mrpt::math::TPoint2D& from, double reach_m, const Visit& visit) const {
    const double distance_m = reach_m + driftTo(from);
    const float limit_m = limitOf(distance_m);
    for (const Neighbour& neighbour : nearestFirst()) {
      if (neighbour.nearest_m > limit_m) break;
      visit(neighbour.solid);
    }
    return covers(distance_m);
  }

 private:
  static constexpr double kSlack_m = 1e-9;  ///< exceeds the rounding error

  mrpt::math::TPoint2D anchor_;
  float covered_m_ = -1;  ///< the list contains all solids within this distance of the anchor
  std::uint8_t size_ = 0;
  std::uint8_t capacity_ = 0;
  std::unique_ptr<Neighbour[]> nearest_first_;
};

}  // namespace robosim
