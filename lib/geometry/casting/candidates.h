#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/index/grid_item.h"

namespace robosim {

/// Solids of a scene that beams of a batch may hit.
struct Candidates {
  static constexpr std::size_t kCapacity = 32;

  std::array<const GridItem*, kCapacity> item;
  std::array<std::uint32_t, kCapacity> body;
  std::size_t count = 0;

  /// Branch-free, because whether a solid is a candidate is unpredictable.
  void addIf(bool condition, const GridItem& solid, std::uint32_t number) {
    item[count] = &solid;
    body[count] = number;
    count += condition ? 1 : 0;
  }
  bool isFull() const { return count == kCapacity; }
};

}  // namespace robosim
