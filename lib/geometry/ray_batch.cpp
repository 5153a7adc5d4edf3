#include "geometry/ray_batch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/level_ray.h"
#include "geometry/vector_clones.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr std::size_t kBlock = 16;
/// Rounding may make a solid seem this much [m] farther off than it is.
constexpr double kSlack_m = 1e-9;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Rays of a batch as bare arrays: what the loops below need to become vector instructions.
struct Rays {
  const double* __restrict x;
  const double* __restrict y;
  const double* __restrict dx;
  const double* __restrict dy;
  double* __restrict distance;
  std::int64_t* __restrict body;
};

/// Keeps a hit at `t` for ray i if it is nearer, or as near and of a lower body; so the order of solids does not
/// matter.
inline void keep(const Rays& rays, std::size_t i, double t, std::int64_t body) {
  const bool keeps = t < rays.distance[i] || (t == rays.distance[i] && body < rays.body[i]);
  rays.distance[i] = keeps ? t : rays.distance[i];
  rays.body[i] = keeps ? body : rays.body[i];
}

ROBOSIM_VECTOR_CLONES
void meetCircle(const Rays& rays, std::size_t begin, std::size_t end, double x, double y, double radius,
                std::int64_t body) {
  for (std::size_t i = begin; i < end; ++i) {
    keep(rays, i, enterCircle(x - rays.x[i], y - rays.y[i], rays.dx[i], rays.dy[i], radius), body);
  }
}

ROBOSIM_VECTOR_CLONES
void meetBox(const Rays& rays, std::size_t begin, std::size_t end, double x, double y, double ux, double uy,
             double half_length, double half_width, std::int64_t body) {
  for (std::size_t i = begin; i < end; ++i) {
    keep(rays, i, enterBox(x - rays.x[i], y - rays.y[i], rays.dx[i], rays.dy[i], ux, uy, half_length, half_width),
         body);
  }
}

/// Cones of directions, by block, and how far the farthest of a block's rays still reaches.
struct Cones {
  const double* __restrict x;
  const double* __restrict y;
  const double* __restrict cos;
  const double* __restrict sin;
  const double* __restrict farthest;
};

/// Notes for each cone of rays that start within some distance of the centre whether one of them may meet a disc at
/// (ox, oy) from it. `reach` is the disc's radius and that distance together; the disc is no nearer to any origin than
/// `nearest`.
ROBOSIM_VECTOR_CLONES
void findTouched(const Cones& cones, std::size_t count, double ox, double oy, double reach, double nearest,
                 std::int64_t* __restrict touched) {
  for (std::size_t i = 0; i < count; ++i) {
    const double along = cones.x[i] * ox + cones.y[i] * oy;
    const double across = std::abs(cones.x[i] * oy - cones.y[i] * ox);
    // Turning from the cone's middle to its edge brings the ray nearer to the disc's centre by the most it can.
    const double least_across = across * cones.cos[i] - std::abs(along) * cones.sin[i];
    const double most_along = along * cones.cos[i] + across * cones.sin[i];
    touched[i] = ((least_across <= reach) & (most_along >= -reach) & (nearest <= cones.farthest[i])) ? 1 : 0;
  }
}

/// The largest of a block's numbers, four at a time.
double largest(const double* block) {
  double most[4] = {block[0], block[1], block[2], block[3]};
  for (std::size_t i = 4; i < kBlock; i += 4) {
    for (std::size_t j = 0; j < 4; ++j) most[j] = block[i + j] > most[j] ? block[i + j] : most[j];
  }
  return std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
}

}  // namespace

void RayBatch::begin(const TPoint2D& center, double z_m, double range_m, std::size_t count) {
  center_ = center;
  z_m_ = z_m;
  range_m_ = range_m;
  size_ = count;
  const std::size_t padded = (count + kBlock - 1) / kBlock * kBlock;
  for (auto* field : {&x_, &y_, &dx_, &dy_}) field->resize(padded);
}

void RayBatch::finish() {
  double spread_m2 = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    const double ox = x_[i] - center_.x;
    const double oy = y_[i] - center_.y;
    spread_m2 = std::max(spread_m2, ox * ox + oy * oy);
  }
  spread_m_ = std::sqrt(spread_m2);
  const std::size_t blocks = x_.size() / kBlock;
  for (auto* field : {&x_, &y_, &dx_, &dy_}) {
    for (std::size_t i = size_; i < field->size(); ++i) (*field)[i] = (*field)[size_ - 1];
  }
  distance_.assign(x_.size(), range_m_);
  body_.assign(x_.size(), kNothing);

  middle_x_.resize(blocks);
  middle_y_.resize(blocks);
  cos_.resize(blocks);
  sin_.resize(blocks);
  touched_.resize(blocks);
  farthest_.assign(blocks, range_m_);
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t first = block * kBlock;
    double mx = dx_[first] + dx_[first + kBlock - 1];
    double my = dy_[first] + dy_[first + kBlock - 1];
    const double length = std::hypot(mx, my);
    mx = length > 1e-6 ? mx / length : dx_[first];
    my = length > 1e-6 ? my / length : dy_[first];
    double least_cos = 1;
    for (std::size_t i = first; i < first + kBlock; ++i) least_cos = std::min(least_cos, mx * dx_[i] + my * dy_[i]);
    // A cone wider than a half-plane tells nothing apart.
    const bool narrow = least_cos > 0.1;
    least_cos = narrow ? std::max(0.0, least_cos - 1e-9) : 0;
    middle_x_[block] = mx;
    middle_y_[block] = my;
    cos_[block] = least_cos;
    sin_[block] = narrow ? std::sqrt(1 - least_cos * least_cos) : kInfinity;
  }
}

double RayBatch::reach() const {
  double farthest_m = 0;
  for (const double d : farthest_) farthest_m = std::max(farthest_m, d);
  return farthest_m + spread_m_;
}

void RayBatch::meet(const GridItem& item, std::int64_t body) {
  const std::size_t blocks = touched_.size();
  if (blocks == 1) return meetBlock(item, body, 0);
  const double ox = item.x - center_.x;
  const double oy = item.y - center_.y;
  const double reach_m = item.reach_m + spread_m_;
  const double nearest_m = std::sqrt(ox * ox + oy * oy) - reach_m - kSlack_m;
  findTouched({middle_x_.data(), middle_y_.data(), cos_.data(), sin_.data(), farthest_.data()}, blocks, ox, oy, reach_m,
              nearest_m, touched_.data());
  for (std::size_t block = 0; block < blocks; ++block) {
    if (touched_[block]) meetBlock(item, body, block);
  }
}

void RayBatch::meetBlock(const GridItem& item, std::int64_t body, std::size_t block) {
  const Rays rays{x_.data(), y_.data(), dx_.data(), dy_.data(), distance_.data(), body_.data()};
  const std::size_t begin = block * kBlock;
  const std::size_t end = begin + kBlock;
  if (item.is_circle) {
    meetCircle(rays, begin, end, item.x, item.y, item.half_length_m, body);
  } else {
    meetBox(rays, begin, end, item.x, item.y, item.axis_x, item.axis_y, item.half_length_m, item.half_width_m, body);
  }
  farthest_[block] = largest(distance_.data() + begin);
}

}  // namespace robosim
