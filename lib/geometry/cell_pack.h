#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "geometry/rough_solid.h"

namespace robosim {

/// Solids that a cell of a grid lists, as the discs that cover them: by field in single precision, so that one vector
/// instruction looks at all, and two cache lines hold them. Where there are fewer than kMost, the others are nowhere. A
/// cell that lists more has another pack, whose number is in the place of the last index.
struct alignas(64) CellPack {
  static constexpr std::size_t kMost = 8;

  float x[kMost], y[kMost], less_reach_m[kMost];
  std::uint32_t index[kMost];  ///< in the order of the grid; kNobody where there is none

  CellPack() {
    for (auto* field : {x, y}) std::fill_n(field, kMost, 0.0F);
    std::fill_n(less_reach_m, kMost, std::numeric_limits<float>::max());  // nothing passes so near
    std::fill_n(index, kMost, kNobody);
  }

  void set(std::size_t i, const RoughSolid& solid, double reach_m, std::uint32_t solid_index) {
    x[i] = solid.x;
    y[i] = solid.y;
    less_reach_m[i] = static_cast<float>(-reach_m);
    index[i] = solid_index;
  }
  /// How many packs so many solids of a cell take: in all but the last there is one less.
  static constexpr std::size_t packsFor(std::size_t solids) {
    return solids <= kMost ? 1 : 1 + (solids - kMost + kBeforeLink - 1) / kBeforeLink;
  }
  static constexpr std::size_t kBeforeLink = kMost - 1;
  void goOnIn(std::uint32_t pack) { index[kMost - 1] = kLink | pack; }
  bool goesOn() const { return index[kMost - 1] >= kLink; }
  /// The number of the cell's next pack.
  std::uint32_t next() const { return index[kMost - 1] & ~kLink; }

  template <typename Visit>
  void visit(const Visit& visit) const {
    for (std::size_t i = 0; i < kMost && index[i] < kNobody; ++i) visit(index[i]);
  }

 private:
  static constexpr std::uint32_t kNobody = 0x7fffffff;
  static constexpr std::uint32_t kLink = 0x80000000;
};

/// The same solids as the rectangles that cover them; a circle as a square about it, whichever way that is turned.
struct alignas(64) CellRectangles {
  float axis_x[CellPack::kMost]{}, axis_y[CellPack::kMost]{};  ///< unit vector along the length
  float half_length_m[CellPack::kMost]{}, half_width_m[CellPack::kMost]{};

  /// @param room_m how much further than to its rim a solid is said to reach
  void set(std::size_t i, const GridItem& item, double room_m) {
    axis_x[i] = static_cast<float>(item.axis_x);
    axis_y[i] = static_cast<float>(item.axis_y);
    half_length_m[i] = static_cast<float>(item.half_length_m + item.round_m + room_m);
    half_width_m[i] = static_cast<float>(item.half_width_m + item.round_m + room_m);
  }
};

}  // namespace robosim
