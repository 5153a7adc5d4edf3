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
  /// Pairs that are worth settling.
  static constexpr std::size_t kEnough = 16;

  /// @param ray its number in the batch; (ox, oy) leads from its origin to the solid's centre; (dx, dy) its direction
  void add(const GridItem& item, std::int64_t body, std::uint32_t ray, double ox, double oy, double dx, double dy) {
    Pairs& pairs = item.isCircle() ? circles_ : boxes_;
    const std::size_t k = pairs.count++;
    pairs.ray[k] = ray;
    pairs.body[k] = body;
    pairs.ox[k] = ox;
    pairs.oy[k] = oy;
    pairs.dx[k] = dx;
    pairs.dy[k] = dy;
    pairs.ux[k] = item.axis_x;
    pairs.uy[k] = item.axis_y;
    pairs.a[k] = item.isCircle() ? item.round_m : item.half_length_m;
    pairs.b[k] = item.half_width_m;
  }
  /// Whether there is enough to settle; if there is, settle() before any more than kEnough others are added.
  bool isFull() const { return circles_.count >= kEnough || boxes_.count >= kEnough; }

  /// Works out where each pair's ray enters its solid, calls keep(ray, distance_m, body) for each (infinite where it
  /// misses), and forgets them.
  template <typename Keep>
  void settle(const Keep& keep) {
    if (circles_.count > 0) {
      enterCircles(circles_);
      handOver(circles_, keep);
    }
    if (boxes_.count > 0) {
      enterBoxes(boxes_);
      handOver(boxes_, keep);
    }
  }

 private:
  static constexpr std::size_t kMost = 2 * kEnough;
  template <typename T>
  using Field = std::array<T, kMost>;

  struct Pairs {
    std::size_t count = 0;
    Field<double> ox{}, oy{}, dx{}, dy{};
    Field<double> ux{}, uy{}, a{}, b{};  ///< of a box: its axis and half its sides; of a circle, `a` is its radius
    Field<double> entered{};
    Field<std::int64_t> body{};
    Field<std::uint32_t> ray{};
  };

  template <typename Keep>
  static void handOver(Pairs& pairs, const Keep& keep) {
    for (std::size_t k = 0; k < pairs.count; ++k) keep(pairs.ray[k], pairs.entered[k], pairs.body[k]);
    pairs.count = 0;
  }
  static void enterCircles(Pairs& pairs);
  static void enterBoxes(Pairs& pairs);

  Pairs circles_, boxes_;
};

}  // namespace robosim
