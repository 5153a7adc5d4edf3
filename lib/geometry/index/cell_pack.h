#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "geometry/index/culling.h"

namespace robosim {

/// Solids of a grid cell, as the discs that cover them: structure of arrays in single precision, so that one vector
/// instruction tests all of them and the arrays fill two cache lines. Unused entries never match. A cell with more than
/// kCapacity solids links to a further pack: the last index then holds that pack's number.
struct alignas(64) CellPack {
  static constexpr std::size_t kCapacity = 8;

  float x[kCapacity], y[kCapacity], negative_reach_m[kCapacity];
  std::uint32_t index[kCapacity];  ///< index into GridIndex::items(); kNoSolid for an unused entry

  CellPack() {
    for (auto* field : {x, y}) std::fill_n(field, kCapacity, 0.0F);
    std::fill_n(negative_reach_m, kCapacity, std::numeric_limits<float>::max());  // never matches
    std::fill_n(index, kCapacity, kNoSolid);
  }

  void set(std::size_t i, const CullSolid& solid, double reach_m, std::uint32_t solid_index) {
    x[i] = solid.x;
    y[i] = solid.y;
    negative_reach_m[i] = static_cast<float>(-reach_m);
    index[i] = solid_index;
  }
  /// Number of packs that hold `solids` solids of a cell. Every pack but the last holds one solid less than kCapacity.
  static constexpr std::size_t packCount(std::size_t solids) {
    return solids <= kCapacity ? 1 : 1 + (solids - kCapacity + kSolidsBeforeLink - 1) / kSolidsBeforeLink;
  }
  static constexpr std::size_t kSolidsBeforeLink = kCapacity - 1;
  void linkTo(std::uint32_t pack) { index[kCapacity - 1] = kLink | pack; }
  bool hasNext() const { return index[kCapacity - 1] >= kLink; }
  /// Number of the cell's next pack.
  std::uint32_t next() const { return index[kCapacity - 1] & ~kLink; }

  template <typename Visit>
  void visit(const Visit& visit) const {
    for (std::size_t i = 0; i < kCapacity && index[i] < kNoSolid; ++i) visit(index[i]);
  }

 private:
  static constexpr std::uint32_t kNoSolid = 0x7fffffff;
  static constexpr std::uint32_t kLink = 0x80000000;
};

/// The same solids as the rectangles that cover them. A circle becomes a square of arbitrary orientation.
struct alignas(64) CellRectangles {
  float axis_x[CellPack::kCapacity]{}, axis_y[CellPack::kCapacity]{};  ///< unit vector along the length
  float half_length_m[CellPack::kCapacity]{}, half_width_m[CellPack::kCapacity]{};

  /// @param margin_m added to the solid's extent on every side
  void set(std::size_t i, const GridItem& item, double margin_m) {
    axis_x[i] = static_cast<float>(item.axis_x);
    axis_y[i] = static_cast<float>(item.axis_y);
    half_length_m[i] = static_cast<float>(item.half_length_m + item.round_m + margin_m);
    half_width_m[i] = static_cast<float>(item.half_width_m + item.round_m + margin_m);
  }
};

}  // namespace robosim
