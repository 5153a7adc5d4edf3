#include "geometry/sector_batch.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "geometry/vector_loops.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr std::size_t kBlock = SectorFan::kBlock;
static_assert(kBlock <= kMaskBits);
/// More than rounding may make of any of the lengths here [m].
constexpr double kSlack_m = 1e-9;

/// Sectors as seen from the batch's centre, as bare arrays: what the loop below needs to become vector instructions.
struct Rough {
  const float* __restrict x;
  const float* __restrict y;
  const float* __restrict axis_x;
  const float* __restrict axis_y;
  const float* __restrict left_x;
  const float* __restrict left_y;
  const float* __restrict right_x;
  const float* __restrict right_y;
  const float* __restrict distance;
};

/// Half of what a solid is wide across a direction.
inline float halfWidth(float dx, float dy, const RoughSolid& solid, float round) {
  return solid.half_length_m * std::abs(dy * solid.axis_x - dx * solid.axis_y) +
         solid.half_width_m * std::abs(dx * solid.axis_x + dy * solid.axis_y) + round;
}

/// Which sectors a solid may reach into, nearer than what they hold already: it lies neither all beyond one of their
/// edges nor all too far along their axis. For each solid and each block of sectors, bit i for sector i.
ROBOSIM_VECTOR_CLONES
void findHolding(const Rough& s, std::size_t blocks, const RoughPlace& place, const RoughSolid* solids,
                 const std::uint32_t* indices, std::size_t count, std::uint32_t* __restrict holding) {
  for (std::size_t j = 0; j < count; ++j) {
    const RoughSolid& solid = solids[indices[j]];
    const float x = solid.x - place.x;
    const float y = solid.y - place.y;
    const float round = solid.round_m + place.lost_m;
    for (std::size_t begin = 0; begin < blocks * kBlock; begin += kBlock) {
      std::uint32_t bits = 0;
      for (std::size_t i = 0; i < kBlock; ++i) {
        const std::size_t k = begin + i;
        const float ox = x - s.x[k];
        const float oy = y - s.y[k];
        const float from_right = s.right_x[k] * oy - s.right_y[k] * ox;
        const float from_left = ox * s.left_y[k] - oy * s.left_x[k];
        const float along = s.axis_x[k] * ox + s.axis_y[k] * oy;
        const bool may_hold = (from_right >= -halfWidth(s.right_x[k], s.right_y[k], solid, round)) &
                              (from_left >= -halfWidth(s.left_x[k], s.left_y[k], solid, round)) &
                              (along - halfWidth(-s.axis_y[k], s.axis_x[k], solid, round) <= s.distance[k]);
        bits += may_hold ? kMaskBit[i] : 0;
      }
      *holding++ = bits;
    }
  }
}

}  // namespace

void SectorBatch::place(const SectorFan& fan, const LevelFrame& world_from_fan, double range_m) {
  const LevelFrame& frame = world_from_fan;
  fan_ = &fan;
  center_ = frame.pointToWorld(fan.middle());
  z_m_ = frame.z() + fan.z();
  spread_m_ = fan.spread() + kSlack_m;
  farthest_m_ = range_m;
  const std::size_t count = fan.apex_.x.size();
  const auto turn = [&](const SectorFan::Vectors& from, double x0, double y0, SectorFan::Vectors& to) {
    to.x.resize(count);
    to.y.resize(count);
    transform(from.x.data(), from.y.data(), count, x0, y0, frame.cos(), frame.sin(), to.x.data(), to.y.data());
  };
  turn(fan.apex_, frame.x(), frame.y(), apex_);
  turn(fan.axis_, 0, 0, axis_);
  turn(fan.left_, 0, 0, left_);
  turn(fan.right_, 0, 0, right_);
  const auto roughen = [&](const SectorFan::Vectors& from, const TPoint2D& middle, std::vector<float>& x,
                           std::vector<float>& y) {
    x.resize(count);
    y.resize(count);
    roughly(from.x.data(), from.y.data(), count, middle.x, middle.y, x.data(), y.data());
  };
  roughen(apex_, center_, rough_.x, rough_.y);
  roughen(axis_, {}, rough_.axis_x, rough_.axis_y);
  roughen(left_, {}, rough_.left_x, rough_.left_y);
  roughen(right_, {}, rough_.right_x, rough_.right_y);
  rough_.distance.assign(count, static_cast<float>(range_m));
  holding_.resize(count / kBlock * Candidates::kMost);
  distance_.assign(count, range_m);
  body_.assign(count, kNothing);
  towards_x_.resize(count);
  towards_y_.resize(count);
}

void SectorBatch::meet(const Candidates& candidates) {
  const std::size_t blocks = distance_.size() / kBlock;
  findHolding({rough_.x.data(), rough_.y.data(), rough_.axis_x.data(), rough_.axis_y.data(), rough_.left_x.data(),
               rough_.left_y.data(), rough_.right_x.data(), rough_.right_y.data(), rough_.distance.data()},
              blocks, RoughPlace::from(center_, spread_m_, candidates.middle), candidates.rough,
              candidates.indices.data(), candidates.indices.size(), holding_.data());
  const std::uint32_t* holding = holding_.data();
  for (const auto index : candidates.indices) {
    const GridItem& item = candidates.items[index];
    const std::int64_t body = candidates.first_body + index;
    for (std::uint32_t begin = 0; begin < blocks * kBlock; begin += kBlock) {
      std::uint32_t bits = *holding++;
      if (bits == 0 || !item.heights.contains(z_m_) || body == candidates.except) continue;
      for (; bits != 0; bits &= bits - 1) {
        const std::uint32_t i = begin + static_cast<std::uint32_t>(std::countr_zero(bits));
        pairs_.add(item, body, i, item.x - apex_.x[i], item.y - apex_.y[i], {left_.x[i], left_.y[i]},
                   {right_.x[i], right_.y[i]});
      }
      if (pairs_.isFull()) settle();
    }
  }
}

void SectorBatch::settle() {
  pairs_.settle([&](std::uint32_t i, const SectorPairs::Nearest& nearest, std::int64_t with) {
    // As near, the one of the lower number: so the order of solids does not matter.
    const bool keeps = nearest.distance_m < distance_[i] || (nearest.distance_m == distance_[i] && with < body_[i]);
    if (!keeps) return;
    distance_[i] = nearest.distance_m;
    rough_.distance[i] = static_cast<float>(nearest.distance_m);
    towards_x_[i] = nearest.x;
    towards_y_[i] = nearest.y;
    body_[i] = with;
  });
  farthest_m_ = largest(distance_.data(), distance_.size());
}

}  // namespace robosim
