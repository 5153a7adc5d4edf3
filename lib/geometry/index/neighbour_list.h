#pragma once
#include <compare>
#include <cstdint>
#include <limits>
#include <vector>

#include <mrpt/math/TPoint2D.h>

namespace robosim {

/// Verlet list of the stationary solids near a moving owner, kept from step to step (Verlet, "Computer 'Experiments' on
/// Classical Fluids", Physical Review 159, 1967). It covers the owner's reach plus a skin and stays valid until the
/// owner has crossed the skin; until then no search is needed. Scene::update() fills it.
class NeighbourList {
 public:
  struct Neighbour {
    float nearest_m;      ///< distance from the anchor to the solid's outline, rounded down
    std::uint32_t solid;  ///< index into GridIndex::items()
    auto operator<=>(const Neighbour&) const = default;
  };

  /// An empty list, which covers nothing.
  NeighbourList() = default;
  /// @param nearest_first all solids within `covered_m` of the anchor, in this order
  void set(const mrpt::math::TPoint2D& anchor, double covered_m, std::vector<Neighbour>& nearest_first) {
    anchor_ = anchor;
    covered_m_ = covered_m;
    nearest_first_.assign(nearest_first.begin(), nearest_first.end());
  }

  /// Distance [m] from the anchor to a point; infinite for an empty list.
  double driftTo(const mrpt::math::TPoint2D& p) const {
    return covered_m_ < 0 ? std::numeric_limits<double>::infinity() : (p - anchor_).norm() + kSlack_m;
  }

  /// Calls visit(solid) for the solids that may lie within reach() of `from`, nearest first. reach() may decrease
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
  static constexpr double kSlack_m = 1e-9;  ///< exceeds the rounding error

  mrpt::math::TPoint2D anchor_;
  double covered_m_ = -1;
  std::vector<Neighbour> nearest_first_;
};

}  // namespace robosim
