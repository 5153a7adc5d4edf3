#include "geometry/ray_batch.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "geometry/level_ray.h"
#include "geometry/vector_loops.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr std::size_t kBlock = RayFan::kBlock;
static_assert(kBlock <= kMaskBits);
/// Rounding may make a solid seem this much [m] farther off than it is.
constexpr double kSlack_m = 1e-9;
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

/// Rays of a block as seen from the batch's centre, in single precision: enough to tell which are worth a sum.
struct RoughRays {
  const float* __restrict x;
  const float* __restrict y;
  const float* __restrict dx;
  const float* __restrict dy;
  const float* __restrict distance;
};

/// Which rays pass through the rectangle about a solid that lies along and across the ray, nearer than they have met
/// something; for each solid and each block of rays, bit i for ray i. Finding that out costs less than the sum for
/// where a ray enters a solid, and of rays that look all ways few do.
ROBOSIM_VECTOR_CLONES
void findPassing(const RoughRays& rays, std::size_t blocks, const RoughPlace& place, const RoughSolid* solids,
                 const std::uint32_t* indices, std::size_t count, std::uint32_t* __restrict passing) {
  for (std::size_t k = 0; k < count; ++k) {
    const RoughSolid& solid = solids[indices[k]];
    const float x = solid.x - place.x;
    const float y = solid.y - place.y;
    const float round = solid.round_m + place.lost_m;
    for (std::size_t begin = 0; begin < blocks * kBlock; begin += kBlock) {
      std::uint32_t bits = 0;
      for (std::size_t i = 0; i < kBlock; ++i) {
        const float dx = rays.dx[begin + i];
        const float dy = rays.dy[begin + i];
        const float ox = x - rays.x[begin + i];
        const float oy = y - rays.y[begin + i];
        const float along = dx * ox + dy * oy;
        const float across = std::abs(dx * oy - dy * ox);
        const float slope_a = std::abs(dx * solid.axis_x + dy * solid.axis_y);
        const float slope_b = std::abs(dy * solid.axis_x - dx * solid.axis_y);
        const float wide = solid.half_length_m * slope_b + solid.half_width_m * slope_a + round;
        const float deep = solid.half_length_m * slope_a + solid.half_width_m * slope_b + round;
        const bool passes = (across <= wide) & (along >= -deep) & (along - deep <= rays.distance[begin + i]);
        bits += passes ? kMaskBit[i] : 0;
      }
      *passing++ = bits;
    }
  }
}

}  // namespace

void RayBatch::place(const RayFan& fan, const LevelFrame& world_from_fan, double range_m, double pan_rad) {
  const LevelFrame& frame = world_from_fan;
  fan_ = &fan;
  center_ = frame.pointToWorld(fan.middle());
  z_m_ = frame.z() + fan.z();
  spread_m_ = fan.spread() + kSlack_m;
  farthest_m_ = range_m;
  const std::size_t rays = fan.x_.size();
  for (auto* field : {&x_, &y_, &dx_, &dy_}) field->resize(rays);
  transform(fan.x_.data(), fan.y_.data(), rays, frame.x(), frame.y(), frame.cos(), frame.sin(), x_.data(), y_.data());
  const LevelFrame panned(frame, pan_rad);
  transform(fan.dx_.data(), fan.dy_.data(), rays, 0, 0, panned.cos(), panned.sin(), dx_.data(), dy_.data());
  distance_.assign(rays, range_m);
  body_.assign(rays, kNothing);

  const std::size_t blocks = fan.blocks();
  if (!fan.isNarrow()) {
    for (auto* field : {&rough_x_, &rough_y_, &rough_dx_, &rough_dy_}) field->resize(rays);
    roughly(x_.data(), y_.data(), rays, center_.x, center_.y, rough_x_.data(), rough_y_.data());
    roughly(dx_.data(), dy_.data(), rays, 0, 0, rough_dx_.data(), rough_dy_.data());
    rough_distance_.assign(rays, static_cast<float>(range_m));
    passing_.resize(blocks * Candidates::kMost);
    open_ = rays;
    return;
  }
  farthest_.assign(blocks, range_m);
  cones_.place(fan.cones_, panned, range_m);
  passing_.resize(cones_.blocks() * Candidates::kMost);
}

void RayBatch::meet(const Candidates& candidates) {
  if (fan_->isNarrow()) {
    meetByBlock(candidates);
  } else {
    meetByRay(candidates);
  }
}

void RayBatch::meetByBlock(const Candidates& candidates) {
  cones_.find(RoughPlace::from(center_, 0, candidates.middle, spread_m_), candidates.rough, candidates.indices,
              passing_.data());
  const std::uint32_t* passing = passing_.data();
  for (const auto index : candidates.indices) {
    const GridItem& item = candidates.items[index];
    const std::int64_t body = candidates.first_body + index;
    for (std::size_t cone = 0; cone < cones_.blocks() * RoughSectors::kBlock; cone += RoughSectors::kBlock) {
      std::uint32_t bits = *passing++;
      if (bits == 0 || !item.heights.contains(z_m_) || body == candidates.except) continue;
      for (; bits != 0; bits &= bits - 1) {
        const std::size_t block = cone + static_cast<std::size_t>(std::countr_zero(bits));
        if (block < farthest_.size()) meetBlock(item, body, block);
      }
    }
  }
  farthest_m_ = *std::max_element(farthest_.begin(), farthest_.end());
}

void RayBatch::meetBlock(const GridItem& item, std::int64_t body, std::size_t block) {
  const Rays rays{x_.data(), y_.data(), dx_.data(), dy_.data(), distance_.data(), body_.data()};
  const std::size_t begin = block * kBlock;
  const std::size_t end = begin + kBlock;
  if (item.is_circle) {
    meetCircle(rays, begin, end, item.x, item.y, item.round_m, body);
  } else {
    meetBox(rays, begin, end, item.x, item.y, item.axis_x, item.axis_y, item.half_length_m, item.half_width_m, body);
  }
  farthest_[block] = largest(distance_.data() + begin, kBlock);
  cones_.setReach(block, farthest_[block]);
}

void RayBatch::meetByRay(const Candidates& candidates) {
  const std::size_t blocks = fan_->blocks();
  findPassing({rough_x_.data(), rough_y_.data(), rough_dx_.data(), rough_dy_.data(), rough_distance_.data()}, blocks,
              RoughPlace::from(center_, spread_m_, candidates.middle), candidates.rough, candidates.indices.data(),
              candidates.indices.size(), passing_.data());
  const std::uint32_t* passing = passing_.data();
  for (const auto index : candidates.indices) {
    const GridItem& item = candidates.items[index];
    const std::int64_t body = candidates.first_body + index;
    for (std::uint32_t begin = 0; begin < blocks * kBlock; begin += kBlock) {
      std::uint32_t bits = *passing++;
      if (bits == 0 || !item.heights.contains(z_m_) || body == candidates.except) continue;
      for (; bits != 0; bits &= bits - 1) {
        const std::uint32_t i = begin + static_cast<std::uint32_t>(std::countr_zero(bits));
        pairs_.add(item, body, i, item.x - x_[i], item.y - y_[i], dx_[i], dy_[i]);
      }
      if (pairs_.isFull()) settle();
    }
  }
}

void RayBatch::settle() {
  const Rays rays{x_.data(), y_.data(), dx_.data(), dy_.data(), distance_.data(), body_.data()};
  pairs_.settle([&](std::uint32_t ray, double t, std::int64_t with) {
    const bool was_open = rays.body[ray] == kNothing;
    keep(rays, ray, t, with);
    rough_distance_[ray] = static_cast<float>(rays.distance[ray]);
    open_ -= (was_open & (rays.body[ray] != kNothing)) ? 1 : 0;
  });
  // While one ray has met nothing, what is farthest is the range.
  if (open_ == 0) farthest_m_ = largest(distance_.data(), distance_.size());
}

}  // namespace robosim
