#pragma once
#include <bit>
#include <cstdint>

#include "geometry/solid_pack.h"
#include "geometry/vector_loops.h"

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
  std::uint32_t first_body;     ///< the number among all bodies of the items' number 0

  /// How many of the pack a loop looks at, in whole vectors.
  std::size_t lanes() const { return (pack.count + 15) / 16 * 16; }

  /// Calls meet(item, body, i) for each mark of a block of masks, `i` being the block's first plus the bit's number.
  /// Leaves out what does not reach to the height `z_m`.
  template <typename Meet>
  void forEachMark(const Masks& masks, double z_m, std::uint32_t first, const Meet& meet) const {
    // How many marks a solid has is anybody's guess: four solids' are gone through together, so that a processor
    // guesses wrong once for the four.
    constexpr std::uint32_t kTogether = 4;
    for (std::uint32_t begin = 0; begin < pack.count; begin += kTogether) {
      std::uint64_t marks = 0;
      for (std::uint32_t k = 0; k < kTogether; ++k) {
        const std::uint64_t of_one = begin + k < pack.count ? masks.of[begin + k] : 0;
        marks |= of_one << (k * kMaskBits);
      }
      for (; marks != 0; marks &= marks - 1) {
        const auto at = static_cast<std::uint32_t>(std::countr_zero(marks));
        const GridItem& item = items[pack.index[begin + at / kMaskBits]];
        if (item.heights.contains(z_m)) meet(item, std::int64_t{first_body} + item.number, first + at % kMaskBits);
      }
    }
  }
};

}  // namespace robosim
