#include "geometry/sector_batch.h"

#include <algorithm>
#include <cmath>

#include "geometry/level_ray.h"
#include "geometry/vector_clones.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr std::size_t kBlock = 8;

/// Sectors of a batch as bare arrays: what the loops below need to become vector instructions.
struct Sectors {
  const double* __restrict x;
  const double* __restrict y;
  const double* __restrict left_x;
  const double* __restrict left_y;
  const double* __restrict right_x;
  const double* __restrict right_y;
  double* __restrict distance;
  double* __restrict towards_x;
  double* __restrict towards_y;
  std::int64_t* __restrict body;
};

/// Nearest point of an outline as seen from an apex, and where the sector's edges enter it: nearestInSector() says why
/// no other point can be the answer. Keeps the nearest of all bodies; as near, the one of the lower number.
inline void keep(const Sectors& s, std::size_t i, double near, double near_x, double near_y, double on_left,
                 double on_right, std::int64_t body) {
  const bool held =
      (s.right_x[i] * near_y - s.right_y[i] * near_x >= 0) & (near_x * s.left_y[i] - near_y * s.left_x[i] >= 0);
  // The left edge wins a tie, as it does for a sector alone.
  const bool left_first = on_left <= on_right;
  const double on_edge = left_first ? on_left : on_right;
  const double edge_x = left_first ? s.left_x[i] : s.right_x[i];
  const double edge_y = left_first ? s.left_y[i] : s.right_y[i];
  const double distance = held ? near : on_edge;
  const double towards_x = held ? near_x : edge_x * on_edge;
  const double towards_y = held ? near_y : edge_y * on_edge;
  const bool keeps = (distance < s.distance[i]) | ((distance == s.distance[i]) & (body < s.body[i]));
  s.distance[i] = keeps ? distance : s.distance[i];
  s.towards_x[i] = keeps ? towards_x : s.towards_x[i];
  s.towards_y[i] = keeps ? towards_y : s.towards_y[i];
  s.body[i] = keeps ? body : s.body[i];
}

ROBOSIM_VECTOR_CLONES
void meetCircle(const Sectors& s, std::size_t count, double x, double y, double radius, std::int64_t body) {
  for (std::size_t i = 0; i < count; ++i) {
    const double ox = x - s.x[i];
    const double oy = y - s.y[i];
    const double far = std::sqrt(ox * ox + oy * oy);
    const bool inside = far <= radius;
    const double near = inside ? 0.0 : far - radius;
    const double share = inside ? 0.0 : near / far;
    keep(s, i, near, ox * share, oy * share, enterCircle(ox, oy, s.left_x[i], s.left_y[i], radius),
         enterCircle(ox, oy, s.right_x[i], s.right_y[i], radius), body);
  }
}

ROBOSIM_VECTOR_CLONES
void meetBox(const Sectors& s, std::size_t count, double x, double y, double ux, double uy, double half_length,
             double half_width, std::int64_t body) {
  for (std::size_t i = 0; i < count; ++i) {
    const double ox = x - s.x[i];
    const double oy = y - s.y[i];
    // The apex in the box's own frame, and from there to the box's nearest point.
    const double a = -(ox * ux + oy * uy);
    const double b = -(oy * ux - ox * uy);
    const double in_a = a < -half_length ? -half_length : (a > half_length ? half_length : a);
    const double in_b = b < -half_width ? -half_width : (b > half_width ? half_width : b);
    const double to_a = in_a - a;
    const double to_b = in_b - b;
    const double near_x = to_a * ux - to_b * uy;
    const double near_y = to_a * uy + to_b * ux;
    keep(s, i, std::sqrt(near_x * near_x + near_y * near_y), near_x, near_y,
         enterBox(ox, oy, s.left_x[i], s.left_y[i], ux, uy, half_length, half_width),
         enterBox(ox, oy, s.right_x[i], s.right_y[i], ux, uy, half_length, half_width), body);
  }
}

}  // namespace

void SectorBatch::begin(const TPoint2D& center, double z_m, double range_m, std::size_t count) {
  center_ = center;
  z_m_ = z_m;
  range_m_ = range_m;
  size_ = count;
  const std::size_t padded = (count + kBlock - 1) / kBlock * kBlock;
  for (auto* field : {&x_, &y_, &left_x_, &left_y_, &right_x_, &right_y_}) field->resize(padded);
}

void SectorBatch::set(std::size_t i, const Sector& sector) {
  x_[i] = sector.apex.x;
  y_[i] = sector.apex.y;
  left_x_[i] = sector.left.x;
  left_y_[i] = sector.left.y;
  right_x_[i] = sector.right.x;
  right_y_[i] = sector.right.y;
}

void SectorBatch::finish() {
  double spread_m2 = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    const double ox = x_[i] - center_.x;
    const double oy = y_[i] - center_.y;
    spread_m2 = std::max(spread_m2, ox * ox + oy * oy);
  }
  spread_m_ = std::sqrt(spread_m2);
  for (auto* field : {&x_, &y_, &left_x_, &left_y_, &right_x_, &right_y_}) {
    for (std::size_t i = size_; i < field->size(); ++i) (*field)[i] = (*field)[size_ - 1];
  }
  const std::size_t padded = x_.size();
  distance_.assign(padded, range_m_);
  towards_x_.assign(padded, 0);
  towards_y_.assign(padded, 0);
  body_.assign(padded, kNothing);
}

double SectorBatch::reach() const {
  double farthest_m = 0;
  for (const double d : distance_) farthest_m = std::max(farthest_m, d);
  return farthest_m + spread_m_;
}

void SectorBatch::meet(const GridItem& item, std::int64_t body) {
  const Sectors s{x_.data(),       y_.data(),        left_x_.data(),    left_y_.data(),    right_x_.data(),
                  right_y_.data(), distance_.data(), towards_x_.data(), towards_y_.data(), body_.data()};
  if (item.is_circle) {
    meetCircle(s, x_.size(), item.x, item.y, item.half_length_m, body);
  } else {
    meetBox(s, x_.size(), item.x, item.y, item.axis_x, item.axis_y, item.half_length_m, item.half_width_m, body);
  }
}

}  // namespace robosim
