#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/grid_index.h"
#include "geometry/sector.h"

namespace robosim {

/// Pairs of a sector and a solid that it may hold some of, as RayPairs are of a ray and a solid: kept until there are
/// enough of them to work out together.
class SectorPairs {
 public:
  static constexpr std::size_t kEnough = 48;

  /// Of a pair: the nearest point of the solid within the sector, from the apex, and its distance; infinite for none.
  struct Nearest {
    double distance_m = 0;
    double x = 0, y = 0;
  };

  /// @param sector its number in the batch; (ox, oy) leads from its apex to the solid's centre
  void add(const GridItem& item, std::int64_t body, std::uint32_t sector, double ox, double oy,
           const mrpt::math::TPoint2D& left, const mrpt::math::TPoint2D& right) {
    Pairs& pairs = item.isCircle() ? circles_ : boxes_;
    const std::size_t k = pairs.count++;
    pairs.sector[k] = sector;
    pairs.body[k] = body;
    pairs.ox[k] = ox;
    pairs.oy[k] = oy;
    pairs.left_x[k] = left.x;
    pairs.left_y[k] = left.y;
    pairs.right_x[k] = right.x;
    pairs.right_y[k] = right.y;
    pairs.ux[k] = item.axis_x;
    pairs.uy[k] = item.axis_y;
    pairs.a[k] = item.half_length_m + item.round_m;  // one of which is 0
    pairs.b[k] = item.half_width_m;
  }
  /// Whether there is enough to settle; if there is, settle() before any more than kEnough others are added.
  bool isFull() const { return circles_.count >= kEnough || boxes_.count >= kEnough; }

  /// Works out each pair, calls keep(sector, nearest, body) for each, and forgets them.
  template <typename Keep>
  void settle(const Keep& keep) {
    if (circles_.count > 0) {
      findInCircles(circles_);
      handOver(circles_, keep);
    }
    if (boxes_.count > 0) {
      findInBoxes(boxes_);
      handOver(boxes_, keep);
    }
  }

 private:
  static constexpr std::size_t kMost = 2 * kEnough;
  template <typename T>
  using Field = std::array<T, kMost>;

  struct Pairs {
    std::size_t count = 0;
    Field<double> ox{}, oy{}, left_x{}, left_y{}, right_x{}, right_y{};
    Field<double> ux{}, uy{}, a{}, b{};  ///< of a box: its axis and half its sides; of a circle, `a` is its radius
    Field<double> distance{}, towards_x{}, towards_y{};
    Field<std::int64_t> body{};
    Field<std::uint32_t> sector{};
  };

  template <typename Keep>
  static void handOver(Pairs& pairs, const Keep& keep) {
    for (std::size_t k = 0; k < pairs.count; ++k) {
      keep(pairs.sector[k], Nearest{pairs.distance[k], pairs.towards_x[k], pairs.towards_y[k]}, pairs.body[k]);
    }
    pairs.count = 0;
  }
  static void findInCircles(Pairs& pairs);
  static void findInBoxes(Pairs& pairs);

  Pairs circles_, boxes_;
};

}  // namespace robosim
