#include "geometry/sector_pairs.h"

#include <cmath>

#include "geometry/level_ray.h"
#include "geometry/vector_loops.h"

namespace robosim {
namespace {

/// Pairs as bare arrays: what the loops below need to become vector instructions.
struct Arrays {
  const double* __restrict ox;
  const double* __restrict oy;
  const double* __restrict left_x;
  const double* __restrict left_y;
  const double* __restrict right_x;
  const double* __restrict right_y;
  const double* __restrict ux;
  const double* __restrict uy;
  const double* __restrict a;
  const double* __restrict b;
  double* __restrict distance;
  double* __restrict towards_x;
  double* __restrict towards_y;
};

/// Nearest point of an outline as seen from an apex, and where the sector's edges enter it: nearestInSector() says why
/// no other point can be the answer.
inline void choose(const Arrays& s, std::size_t k, double near, double near_x, double near_y, double on_left,
                   double on_right) {
  const bool held =
      (s.right_x[k] * near_y - s.right_y[k] * near_x >= 0) & (near_x * s.left_y[k] - near_y * s.left_x[k] >= 0);
  // The left edge wins a tie, as it does for a sector alone.
  const bool left_first = on_left <= on_right;
  const double on_edge = left_first ? on_left : on_right;
  const double edge_x = left_first ? s.left_x[k] : s.right_x[k];
  const double edge_y = left_first ? s.left_y[k] : s.right_y[k];
  s.distance[k] = held ? near : on_edge;
  s.towards_x[k] = held ? near_x : edge_x * on_edge;
  s.towards_y[k] = held ? near_y : edge_y * on_edge;
}

ROBOSIM_VECTOR_CLONES
void nearestInCircles(const Arrays& s, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    const double ox = s.ox[k];
    const double oy = s.oy[k];
    const double radius = s.a[k];
    const double far = std::sqrt(ox * ox + oy * oy);
    const bool inside = far <= radius;
    const double near = inside ? 0.0 : far - radius;
    const double share = inside ? 0.0 : near / far;
    choose(s, k, near, ox * share, oy * share, enterCircle(ox, oy, s.left_x[k], s.left_y[k], radius),
           enterCircle(ox, oy, s.right_x[k], s.right_y[k], radius));
  }
}

ROBOSIM_VECTOR_CLONES
void nearestInBoxes(const Arrays& s, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    const double ox = s.ox[k];
    const double oy = s.oy[k];
    const double ux = s.ux[k];
    const double uy = s.uy[k];
    const double half_length = s.a[k];
    const double half_width = s.b[k];
    // The apex in the box's own frame, and from there to the box's nearest point.
    const double a = -(ox * ux + oy * uy);
    const double b = -(oy * ux - ox * uy);
    const double in_a = a < -half_length ? -half_length : (a > half_length ? half_length : a);
    const double in_b = b < -half_width ? -half_width : (b > half_width ? half_width : b);
    const double to_a = in_a - a;
    const double to_b = in_b - b;
    const double near_x = to_a * ux - to_b * uy;
    const double near_y = to_a * uy + to_b * ux;
    choose(s, k, std::sqrt(near_x * near_x + near_y * near_y), near_x, near_y,
           enterBox(ox, oy, s.left_x[k], s.left_y[k], ux, uy, half_length, half_width),
           enterBox(ox, oy, s.right_x[k], s.right_y[k], ux, uy, half_length, half_width));
  }
}

template <typename Pairs>
Arrays arraysOf(Pairs& p) {
  return {p.ox.data(),       p.oy.data(),        p.left_x.data(),   p.left_y.data(), p.right_x.data(),
          p.right_y.data(),  p.ux.data(),        p.uy.data(),       p.a.data(),      p.b.data(),
          p.distance.data(), p.towards_x.data(), p.towards_y.data()};
}

}  // namespace

void SectorPairs::findInCircles(Pairs& p) { nearestInCircles(arraysOf(p), wholeVectors(p.count)); }
void SectorPairs::findInBoxes(Pairs& p) { nearestInBoxes(arraysOf(p), wholeVectors(p.count)); }

}  // namespace robosim
