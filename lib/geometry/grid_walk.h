#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>

#include "geometry/grid_index.h"
#include "geometry/two.h"

namespace robosim {

/// The way of a level ray from cell to cell, begun inside a grid, until its reach or the grid ends (Amanatides & Woo,
/// "A fast voxel traversal algorithm for ray tracing", Eurographics 1987). Which border comes next is anybody's guess,
/// so nothing is a branch but whether the way goes on: it is counted in whole numbers, of which g++ chooses one without
/// a branch, as it does not with doubles. They count units of 2^-44 of a cell. Borders that are kFar away, 131,072
/// cells, are never come to: a grid has no more than 32,768 a side.
class GridWalk {
 public:
  /// @param in the ray's origin in cells, which the grid holds
  [[gnu::always_inline]] GridWalk(const GridIndex& grid, const Two& in, const Two& direction)
      : units_per_m_(kUnits * grid.perMetre()) {
    const auto column = static_cast<std::int64_t>(in[0]);
    const auto row = static_cast<std::int64_t>(in[1]);
    const std::int64_t columns = grid.columns();
    pack_ = grid.packs().data() + (row * columns + column);

    const Two cell{static_cast<double>(column), static_cast<double>(row)};
    const TwoWhole down = reinterpret_cast<TwoWhole>(direction) >> 63;  // -1 for yes, 0 for no
    const Two border = cell + 1 - where(down, both(1));
    const Two rim = grid.cells() - where(down, grid.cells());
    const Two per = kUnits / direction;
    const TwoWhole next = __builtin_convertvector(capped((border - in) * per), TwoWhole);
    const TwoWhole between = __builtin_convertvector(capped(withoutSign(per)), TwoWhole);
    const Two to_rim = capped((rim - in) * per);
    // A little before the rim, for the borders on the way there are sums of rounded numbers.
    to_rim_ = least(to_rim, swapped(to_rim)) - kBeforeRim;

    next_x_ = next[0];
    next_y_ = next[1];
    between_x_ = between[0];
    between_y_ = between[1];
    step_x_ = (1 ^ down[0]) - down[0];
    step_y_ = (columns ^ down[1]) - down[1];
  }

  /// The first pack of the cell that the ray has come to.
  const CellPack* pack() const { return pack_; }

  /// Ends the way so far from the ray's origin, at least 0; at the rim where that is no number. To be called before
  /// goOn().
  [[gnu::always_inline]] void setReach(double reach_m) {
    reach_ = static_cast<std::int64_t>(least(inUnits(reach_m), to_rim_)[0]);
  }
  /// Whether the ray leaves the grid nearer than that.
  bool leavesWithin(double reach_m) const { return inUnits(reach_m)[0] >= to_rim_[0]; }

  /// Goes on to the next cell, unless it begins at the end or beyond.
  [[gnu::always_inline]] bool goOn() {
    const std::int64_t less = next_x_ - next_y_;
    const std::int64_t in_x = less >> 63;
    const std::int64_t next = std::min(next_x_, next_y_);
    if (next >= reach_) return false;
    pack_ += less < 0 ? step_x_ : step_y_;
    next_x_ += between_x_ & in_x;
    next_y_ += between_y_ & ~in_x;
    return true;
  }

 private:
  static constexpr double kUnits = std::int64_t{1} << 44;
  static constexpr double kFar = std::int64_t{1} << 61;
  /// More than all roundings of a way together, and less than GridIndex::roomAtRim().
  static constexpr double kBeforeRim = std::int64_t{1} << 20;

  static Two where(const TwoWhole& is, const Two& value) {
    return reinterpret_cast<Two>(is & reinterpret_cast<TwoWhole>(value));
  }
  static Two withoutSign(const Two& value) {
    return reinterpret_cast<Two>(reinterpret_cast<TwoWhole>(value) & std::numeric_limits<std::int64_t>::max());
  }
  /// Along one axis the other one's borders are infinitely far, or, for a ray on such a border, it is no number.
  static Two capped(const Two& way) { return least(way, both(kFar)); }
  Two inUnits(double distance_m) const { return Two{distance_m * units_per_m_, 0}; }

  double units_per_m_;
  Two to_rim_;  ///< in the first lane
  const CellPack* pack_;
  std::int64_t next_x_, next_y_;        ///< from the origin to the next border
  std::int64_t between_x_, between_y_;  ///< borders
  std::int64_t step_x_, step_y_;        ///< to the next cell's pack
  std::int64_t reach_ = 0;
};

}  // namespace robosim
