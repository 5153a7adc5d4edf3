#include "geometry/ray_batch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/level_ray.h"
#include "geometry/vector_loops.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr std::size_t kBlock = RayFan::kBlock;
/// Rounding may make a solid seem this much [m] farther off than it is.
constexpr double kSlack_m = 1e-9;
constexpr double kFloatMax = std::numeric_limits<float>::max();

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
  const bool keeps = (t < rays.distance[i]) | ((t == rays.distance[i]) & (body < rays.body[i]));
  rays.distance[i] = keeps ? t : rays.distance[i];
  rays.body[i] = keeps ? body : rays.body[i];
}

static_assert(kBlock % kLanes == 0);

/// Holds a solid against `vectors` times kLanes rays.
ROBOSIM_VECTOR_CLONES
void meetCircle(const Rays& rays, std::size_t begin, std::size_t vectors, double x, double y, double radius,
                std::int64_t body) {
  for (; vectors > 0; --vectors, begin += kLanes) {
    for (std::size_t i = begin; i < begin + kLanes; ++i) {
      keep(rays, i, enterCircle(x - rays.x[i], y - rays.y[i], rays.dx[i], rays.dy[i], radius), body);
    }
  }
}

ROBOSIM_VECTOR_CLONES
void meetBox(const Rays& rays, std::size_t begin, std::size_t vectors, double x, double y, double ux, double uy,
             double half_length, double half_width, std::int64_t body) {
  for (; vectors > 0; --vectors, begin += kLanes) {
    for (std::size_t i = begin; i < begin + kLanes; ++i) {
      keep(rays, i, enterBox(x - rays.x[i], y - rays.y[i], rays.dx[i], rays.dy[i], ux, uy, half_length, half_width),
           body);
    }
  }
}

/// Rays of a fan, in its own frame.
struct RaysOfFan {
  const double* __restrict x;
  const double* __restrict y;
  const double* __restrict dx;
  const double* __restrict dy;
};

/// Puts the rays of a fan where its carrier is; none has met anything yet.
/// @param panned `frame`, but turned as the rays are turned about their own origins
ROBOSIM_VECTOR_CLONES
void putInWorld(const RaysOfFan& of, std::size_t count, const LevelFrame& frame, const LevelFrame& panned,
                double range_m, double* __restrict x, double* __restrict y, double* __restrict dx,
                double* __restrict dy, double* __restrict distance, std::int64_t* __restrict body) {
  const double x0 = frame.x();
  const double y0 = frame.y();
  const double cos = frame.cos();
  const double sin = frame.sin();
  const double panned_cos = panned.cos();
  const double panned_sin = panned.sin();
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = x0 + cos * of.x[i] - sin * of.y[i];
    y[i] = y0 + sin * of.x[i] + cos * of.y[i];
    dx[i] = panned_cos * of.dx[i] - panned_sin * of.dy[i];
    dy[i] = panned_sin * of.dx[i] + panned_cos * of.dy[i];
    distance[i] = range_m;
    body[i] = RayBatch::kNothing;
  }
}

/// Sees rays from a place, in single precision.
ROBOSIM_VECTOR_CLONES
void seeFrom(double x0, double y0, const Rays& rays, std::size_t count, float* __restrict x, float* __restrict y,
             float* __restrict dx, float* __restrict dy, float* __restrict distance) {
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = static_cast<float>(rays.x[i] - x0);
    y[i] = static_cast<float>(rays.y[i] - y0);
    dx[i] = static_cast<float>(rays.dx[i]);
    dy[i] = static_cast<float>(rays.dy[i]);
    distance[i] = static_cast<float>(rays.distance[i]);
  }
}

/// Rays of a block as seen from the batch's centre, in single precision: enough to tell which are worth a sum.
struct RoughBlock {
  const float* __restrict x;
  const float* __restrict y;
  const float* __restrict dx;
  const float* __restrict dy;
  const float* __restrict distance;
};

/// Which rays of a block pass through the rectangle about each solid that lies along and across the ray, nearer than
/// they have met something. Finding that out costs less than the sum for where a ray enters a solid, and of rays that
/// look all ways few do.
ROBOSIM_VECTOR_CLONES
void findPassing(const RoughBlock& rays, const RoughPlace& place, const Candidates::Pack& solids,
                 std::uint32_t* __restrict passing) {
  for (std::size_t k = 0; k < solids.count; ++k) {
    const float x = solids.x[k] - place.x;
    const float y = solids.y[k] - place.y;
    const float axis_x = solids.axis_x[k];
    const float axis_y = solids.axis_y[k];
    const float half_length = solids.half_length_m[k];
    const float half_width = solids.half_width_m[k];
    const float round = solids.round_m[k] + place.lost_m;
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < kBlock; ++i) {
      const float dx = rays.dx[i];
      const float dy = rays.dy[i];
      const float ox = x - rays.x[i];
      const float oy = y - rays.y[i];
      const float along = dx * ox + dy * oy;
      const float across = std::abs(dx * oy - dy * ox);
      const float slope_a = std::abs(dx * axis_x + dy * axis_y);
      const float slope_b = std::abs(dy * axis_x - dx * axis_y);
      const float wide = half_length * slope_b + half_width * slope_a + round;
      const float deep = half_length * slope_a + half_width * slope_b + round;
      const float beyond = along - rays.distance[i];  // as in rough_ray.h
      const bool passes = (across <= wide) & ((beyond > -along ? beyond : -along) <= deep);
      bits += passes ? kMaskBit[i] : 0;
    }
    passing[k] = bits;
  }
}

}  // namespace

void RayBatch::place(const RayFan& fan, const LevelFrame& world_from_fan, double range_m, double pan_rad) {
  fan_ = &fan;
  world_from_fan_ = world_from_fan;
  pan_rad_ = pan_rad;
  is_laid_out_ = false;
  center_ = world_from_fan.pointToWorld(fan.middle());
  z_m_ = world_from_fan.z() + fan.z();
  spread_m_ = fan.spread() + kSlack_m;
  farthest_m_ = range_m;
}

Front RayBatch::front() const {
  return {center_, LevelFrame(world_from_fan_, pan_rad_).turnToWorld(fan_->facing()), spread_m_};
}

void RayBatch::layOut() {
  is_laid_out_ = true;
  const RayFan& fan = *fan_;
  const std::size_t count = fan.x_.size();
  if (x_.size() != count) {
    for (auto* field : {&x_, &y_, &dx_, &dy_, &distance_}) field->resize(count);
    for (auto* field : {&rough_x_, &rough_y_, &rough_dx_, &rough_dy_, &rough_distance_}) field->resize(count);
    body_.resize(count);
  }
  const LevelFrame panned(world_from_fan_, pan_rad_);
  putInWorld({fan.x_.data(), fan.y_.data(), fan.dx_.data(), fan.dy_.data()}, count, world_from_fan_, panned,
             farthest_m_, x_.data(), y_.data(), dx_.data(), dy_.data(), distance_.data(), body_.data());
  // What fills the last block up never meets anything.
  std::fill(distance_.begin() + static_cast<std::ptrdiff_t>(size()), distance_.end(), -kFloatMax);
  if (!fan.isSweep()) {
    const Rays rays{x_.data(), y_.data(), dx_.data(), dy_.data(), distance_.data(), body_.data()};
    seeFrom(center_.x, center_.y, rays, count, rough_x_.data(), rough_y_.data(), rough_dx_.data(), rough_dy_.data(),
            rough_distance_.data());
    passing_.resize(fan.blocks());
  }
}

void RayBatch::meet(const Candidates& candidates) {
  if (!is_laid_out_) layOut();
  if (fan_->isSweep()) {
    meetByBearing(candidates);
  } else {
    meetByRay(candidates);
  }
}

void RayBatch::meetByBearing(const Candidates& candidates) {
  RayBearings::Ranges ranges;
  fan_->bearings_.find(RoughPlace::from(center_, 0, candidates.middle, spread_m_),
                       LevelFrame(world_from_fan_, pan_rad_).turnToWorld(fan_->bearings_.ahead()), candidates, ranges);
  const Rays rays{x_.data(), y_.data(), dx_.data(), dy_.data(), distance_.data(), body_.data()};
  for (std::size_t k = 0; k < candidates.pack.count; ++k) {
    const GridItem& item = candidates.items[candidates.pack.index[k]];
    if (ranges[k].begin == ranges[k].end || !item.heights.contains(z_m_)) continue;
    // In whole vectors: it is no matter that a few rays more are held against it.
    const std::size_t vectors = wholeVectors(ranges[k].end - ranges[k].begin) / kLanes;
    const std::size_t begin = std::min(std::size_t{ranges[k].begin}, x_.size() - vectors * kLanes);
    if (largest(distance_.data() + begin, vectors * kLanes) < ranges[k].nearest_m) continue;  // it is hidden from all
    const std::int64_t body = std::int64_t{candidates.first_body} + item.number;
    if (item.isCircle()) {
      meetCircle(rays, begin, vectors, item.x, item.y, item.round_m, body);
    } else {
      meetBox(rays, begin, vectors, item.x, item.y, item.axis_x, item.axis_y, item.half_length_m, item.half_width_m,
              body);
    }
  }
  farthest_m_ = largest(distance_.data(), distance_.size());
}

void RayBatch::meetByRay(const Candidates& candidates) {
  const auto place = RoughPlace::from(center_, spread_m_, candidates.middle);
  for (std::size_t block = 0; block < fan_->blocks(); ++block) {
    const std::size_t begin = block * kBlock;
    findPassing({rough_x_.data() + begin, rough_y_.data() + begin, rough_dx_.data() + begin, rough_dy_.data() + begin,
                 rough_distance_.data() + begin},
                place, candidates.pack, passing_[block].of);
    candidates.forEachMark(passing_[block], z_m_, static_cast<std::uint32_t>(begin),
                           [&](const GridItem& item, std::int64_t body, std::uint32_t i) {
                             pairs_.add(item, body, i, item.x - x_[i], item.y - y_[i], dx_[i], dy_[i]);
                             if (pairs_.isFull()) settle();
                           });
  }
}

void RayBatch::settle() {
  const Rays rays{x_.data(), y_.data(), dx_.data(), dy_.data(), distance_.data(), body_.data()};
  pairs_.settle([&](std::uint32_t ray, double t, std::int64_t with) {
    keep(rays, ray, t, with);
    rough_distance_[ray] = static_cast<float>(rays.distance[ray]);
  });
  farthest_m_ = largest(distance_.data(), distance_.size());
}

}  // namespace robosim
