#pragma once
#include <cstddef>
#include <cstring>

#include "base/quads.h"
#include "geometry/index/grid_item.h"

namespace robosim {

/// The fields of four items, transposed in registers.
struct ItemsOfFour {
  DoubleQuad x, y, axis_x, axis_y, half_length, half_width, z_min, z_max;

  [[gnu::always_inline]] ItemsOfFour(const GridItem& a, const GridItem& b, const GridItem& c, const GridItem& d) {
    transpose(a, b, c, d, 0, x, y, axis_x, axis_y);
    transpose(a, b, c, d, sizeof(DoubleQuad), half_length, half_width, z_min, z_max);
  }

 private:
  static_assert(offsetof(GridItem, x) == 0 && offsetof(GridItem, axis_y) == 24 &&
                offsetof(GridItem, half_length_m) == 32 && offsetof(GridItem, heights) == 48);

  [[gnu::always_inline]] static void transpose(const GridItem& a, const GridItem& b, const GridItem& c,
                                               const GridItem& d, std::size_t offset, DoubleQuad& first,
                                               DoubleQuad& second, DoubleQuad& third, DoubleQuad& fourth) {
    DoubleQuad row_a, row_b, row_c, row_d;
    const auto load = [offset](const GridItem& item, DoubleQuad& row) __attribute__((always_inline)) {
      std::memcpy(&row, reinterpret_cast<const char*>(&item) + offset, sizeof row);
    };
    load(a, row_a);
    load(b, row_b);
    load(c, row_c);
    load(d, row_d);
    const auto low_ab = __builtin_shufflevector(row_a, row_b, 0, 4, 2, 6);
    const auto high_ab = __builtin_shufflevector(row_a, row_b, 1, 5, 3, 7);
    const auto low_cd = __builtin_shufflevector(row_c, row_d, 0, 4, 2, 6);
    const auto high_cd = __builtin_shufflevector(row_c, row_d, 1, 5, 3, 7);
    first = __builtin_shufflevector(low_ab, low_cd, 0, 1, 4, 5);
    second = __builtin_shufflevector(high_ab, high_cd, 0, 1, 4, 5);
    third = __builtin_shufflevector(low_ab, low_cd, 2, 3, 6, 7);
    fourth = __builtin_shufflevector(high_ab, high_cd, 2, 3, 6, 7);
  }
};

}  // namespace robosim
