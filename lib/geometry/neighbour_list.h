#pragma once
#include <compare>
#include <cstdint>
#include <limits>
#include <vector>

#include <mrpt/math/TPoint2D.h>

namespace robosim {

/// The stationary solids around something that moves, kept from step to step: a neighbour list with a skin, as
/// molecular dynamics keeps them (Verlet, "Computer 'Experiments' on Classical Fluids", Physical Review 159, 1967).
/// It lists what lies within the owner's reach and a skin beyond, so it stays true until the owner has crossed the
/// skin; until then nobody searches. Scene::update() fills it.
class NeighbourList {
 public:
  struct Neighbour {
    float nearest_m;      ///< from the anchor to its outline, rounded down
    std::uint32_t solid;  ///< in the order of the index
    auto operator<=>(const Neighbour&) const = default;
  };

  /// An empty list, which knows of nothing.
  NeighbourList() = default;
  /// @param nearest_first all solids no further than `covered_m` from the anchor, in this order
  void set(const mrpt::math::TPoint2D& anchor, double covered_m, std::vector<Neighbour>& nearest_first) {
    anchor_ = anchor;
    covered_m_ = covered_m;
    nearest_first_.assign(nearest_first.begin(), nearest_first.end());
  }

  /// How far a point lies from where the list was made [m]; infinite for an empty list.
  double driftTo(const mrpt::math::TPoint2D& p) const {
    return covered_m_ < 0 ? std::numeric_limits<double>::infinity() : (p - anchor_).norm() + kSlack_m;
  }

  /// Calls visit(solid) for what may lie within reach() of `from`, the nearest first; reach() may shrink meanwhile.
  /// @return whether that was all there is; if not, the list does not reach far enough.
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
  static constexpr double kSlack_m = 1e-9;  ///< more than the rounding of any of these distances

  mrpt::math::TPoint2D anchor_;
  double covered_m_ = -1;
  std::vector<Neighbour> nearest_first_;
};

}  // namespace robosim
