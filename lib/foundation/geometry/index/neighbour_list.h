#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/index/grid_index.h"

namespace robosim {

/// Verlet list of the stationary solids near a moving owner, kept from step to step (Verlet, "Computer 'Experiments' on
/// Classical Fluids", Physical Review 159, 1967). It covers the owner's reach plus a skin and stays valid until the
/// owner has crossed the skin; until then no search is needed.
class NeighbourList {
 public:
  /// Rebuilds the list, if the owner has crossed the skin, so that it covers the solids within `reach_m` of a point, or
  /// the nearest ones if there are very many.
  void update(const GridIndex& solids, const mrpt::math::TPoint2D& at, double reach_m);

  std::size_t size() const { return nearest_first_.size(); }
  /// Calls visit(index) for the solids that may lie within reach() of `from`, nearest first. reach() may decrease
  /// between calls.
  /// @return whether the list covers reach(); if not, there may be further solids
  template <typename Reach, typename Visit>
  bool visitNear(const mrpt::math::TPoint2D& from, const Reach& reach, const Visit& visit) const {
    const double drift_m = driftTo(from);
    for (const auto& neighbour : nearest_first_) {
      if (neighbour.nearest_m - drift_m > reach()) return true;
      visit(neighbour.solid);
    }
    return reach() + drift_m <= covered_m_;
  }

 private:
  struct Neighbour {
    float nearest_m;      ///< distance from the anchor to the solid's outline, rounded down
    std::uint32_t solid;  ///< index into GridIndex::items()
  };
  static constexpr double kSlack_m = 1e-9;  ///< exceeds the rounding error

  /// Distance [m] from the anchor to a point; infinite for an empty list.
  double driftTo(const mrpt::math::TPoint2D& p) const {
    return covered_m_ < 0 ? std::numeric_limits<double>::infinity() : (p - anchor_).norm() + kSlack_m;
  }

  mrpt::math::TPoint2D anchor_;
  double covered_m_ = -1;  ///< the list contains all solids within this distance of the anchor
  std::vector<Neighbour> nearest_first_;
};

}  // namespace robosim
