#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/grid_index.h"

namespace robosim {

/// Pairs of a ray and a solid that it may meet, kept until there are enough of them to work out together, in loops that
/// become vector instructions.
class RayPairs {
 public:
  /// @param ray its number in the batch; (ox, oy) leads from its origin to the solid's centre; (dx, dy) its direction
  void add(const GridItem& item, std::int64_t body, std::uint32_t ray, double ox, double oy, double dx, double dy) {
    const std::size_t k = count_++;
    ray_[k] = ray;
    body_[k] = body;
    ox_[k] = ox;
    oy_[k] = oy;
    dx_[k] = dx;
    dy_[k] = dy;
    axis_x_[k] = item.axis_x;
    axis_y_[k] = item.axis_y;
    half_length_[k] = item.half_length_m;
    half_width_[k] = item.half_width_m;
    round_[k] = item.round_m;
  }
  /// Whether no more may be added before settle().
  bool isFull() const { return count_ == kMost; }

  /// Works out where each pair's ray enters its solid, calls keep(ray, distance_m, body) for each (infinite where it
  /// misses), and forgets them.
  template <typename Keep>
  void settle(const Keep& keep) {
    enterAll();
    for (std::size_t k = 0; k < count_; ++k) keep(ray_[k], entered_[k], body_[k]);
    count_ = 0;
  }

 private:
  static constexpr std::size_t kMost = 32;
  template <typename T>
  using Field = std::array<T, kMost>;

  void enterAll();

  std::size_t count_ = 0;
  Field<double> ox_{}, oy_{}, dx_{}, dy_{};
  Field<double> axis_x_{}, axis_y_{}, half_length_{}, half_width_{}, round_{};  ///< of the solid
  Field<double> entered_{};
  Field<std::int64_t> body_{};
  Field<std::uint32_t> ray_{};
};

}  // namespace robosim
