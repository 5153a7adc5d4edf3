#pragma once
#include <bit>
#include <cstdint>

#include "geometry/solid_pack.h"

namespace robosim {

/// Some solids of a scene that a batch of rays or sectors may meet.
struct Candidates {
  using Pack = SolidPack<32>;
  /// For each of the pack: bit i for ray or sector i of a block that may meet it.
  struct Masks {
    std::uint32_t of[Pack::kMost];
  };

  const Pack& pack;
  const GridItem* items;        ///< by index
  mrpt::math::TPoint2D middle;  ///< from where the pack sees its solids
  std::uint32_t first_body;     ///< the number among all bodies of index 0
  std::int64_t except;          ///< the number of a body that is left out, or a negative one

  /// How many of the pack a loop looks at, in whole vectors.
  std::size_t lanes() const { return (pack.count + 15) / 16 * 16; }

  /// Calls meet(item, body, i) for each mark of a block of masks, `i` being the block's first plus the bit's number.
  /// Leaves out the one that is left out, and what does not reach to the height `z_m`.
  template <typename Meet>
  void forEachMark(const Masks& masks, double z_m, std::uint32_t first, const Meet& meet) const {
    for (std::uint32_t k = 0; k < pack.count; ++k) {
      if (masks.of[k] == 0) continue;
      const GridItem& item = items[pack.index[k]];
      const std::int64_t body = first_body + pack.index[k];
      if (!item.heights.contains(z_m) || body == except) continue;
      for (std::uint32_t bits = masks.of[k]; bits != 0; bits &= bits - 1) {
        meet(item, body, first + static_cast<std::uint32_t>(std::countr_zero(bits)));
      }
    }
  }
};

}  // namespace robosim
