#pragma once
#include <cstddef>
#include <cstdint>

namespace robosim {

/// Where level rays are on their ways through the cells of a grid, each at a pack of the solids listed there: all go on
/// to their next pack together, in loops that become vector instructions. GridIndex moves them.
struct RayWalks {
  static constexpr std::size_t kTogether = 8;
  static constexpr std::size_t kMost = 128;  ///< that the processor's nearest memory has room for
  template <typename T>
  struct alignas(64) Field {
    T of[kMost]{};
    T& operator[](std::size_t i) { return of[i]; }
    const T& operator[](std::size_t i) const { return of[i]; }
  };

  Field<double> x, y, dx, dy;  ///< origin [m] and direction
  Field<double> reach_m;       ///< further nobody wants to know what is on the way; may shrink

  Field<std::int64_t> pack;     ///< the number of the one that each is at; of an empty cell, any
  std::size_t going_count = 0;  ///< how many have not come to their end
  /// The numbers of those; and after them the first one's, up to a multiple of kTogether.
  Field<std::uint32_t> going;

  // The rest is how a ray goes on; by axis as in GridIndex::visitAlong().
  Field<std::int64_t> end_pack, cell;  ///< the end of the cell's packs; its number
  Field<std::int64_t> goes_on;         ///< -1 where there is a next pack within reach, 0 elsewhere
  struct Axis {
    Field<double> next_m, delta_m;
    Field<std::int64_t> left, step;  ///< step: to the number of the next cell
  } along_x, along_y;
};

}  // namespace robosim
