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

/// Sectors of a batch as bare arrays: what the loop below needs to become vector instructions.
struct Sectors {
  const double* __restrict x;
  const double* __restrict y;
  const double* __restrict axis_x;
  const double* __restrict axis_y;
  const double* __restrict left_x;
  const double* __restrict left_y;
  const double* __restrict right_x;
  const double* __restrict right_y;
  const double* __restrict distance;
};

/// Half of what a solid is wide across a direction.
inline double halfWidth(double dx, double dy, double ux, double uy, double half_length, double half_width,
                        double round) {
  return half_length * std::abs(dy * ux - dx * uy) + half_width * std::abs(dx * ux + dy * uy) + round;
}

/// Which of a block's sectors a solid may reach into, nearer than what they hold already: it lies neither all beyond
/// one of their edges nor all too far along their axis. Bit i for sector i.
ROBOSIM_VECTOR_CLONES
std::uint64_t sectorsThatMayHold(const Sectors& s, std::size_t begin, double x, double y, double ux, double uy,
                                 double half_length, double half_width, double round) {
  std::uint64_t holding = 0;
  for (std::size_t i = 0; i < kBlock; ++i) {
    const std::size_t k = begin + i;
    const double ox = x - s.x[k];
    const double oy = y - s.y[k];
    const double from_right = s.right_x[k] * oy - s.right_y[k] * ox;
    const double from_left = ox * s.left_y[k] - oy * s.left_x[k];
    const double along = s.axis_x[k] * ox + s.axis_y[k] * oy;
    const double right = halfWidth(s.right_x[k], s.right_y[k], ux, uy, half_length, half_width, round);
    const double left = halfWidth(s.left_x[k], s.left_y[k], ux, uy, half_length, half_width, round);
    const double deep = halfWidth(-s.axis_y[k], s.axis_x[k], ux, uy, half_length, half_width, round);
    const bool may_hold = (from_right >= -right) & (from_left >= -left) & (along - deep <= s.distance[k]);
    holding += may_hold ? kMaskBit[i] : 0;
  }
  return holding;
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
  distance_.assign(count, range_m);
  body_.assign(count, kNothing);
  towards_x_.resize(count);
  towards_y_.resize(count);
}

void SectorBatch::meet(const GridItem& item, std::int64_t body) {
  const Sectors sectors{apex_.x.data(), apex_.y.data(),  axis_.x.data(),  axis_.y.data(),  left_.x.data(),
                        left_.y.data(), right_.x.data(), right_.y.data(), distance_.data()};
  for (std::size_t begin = 0; begin < distance_.size(); begin += kBlock) {
    std::uint64_t holding = sectorsThatMayHold(sectors, begin, item.x, item.y, item.axis_x, item.axis_y,
                                               item.half_length_m, item.half_width_m, item.round_m + kSlack_m);
    for (; holding != 0; holding &= holding - 1) {
      const std::size_t i = begin + static_cast<std::size_t>(std::countr_zero(holding));
      pairs_.add(item, body, static_cast<std::uint32_t>(i), item.x - apex_.x[i], item.y - apex_.y[i],
                 {left_.x[i], left_.y[i]}, {right_.x[i], right_.y[i]});
    }
    if (pairs_.isFull()) settle();
  }
}

void SectorBatch::settle() {
  pairs_.settle([&](std::uint32_t i, const SectorPairs::Nearest& nearest, std::int64_t with) {
    // As near, the one of the lower number: so the order of solids does not matter.
    const bool keeps = nearest.distance_m < distance_[i] || (nearest.distance_m == distance_[i] && with < body_[i]);
    if (!keeps) return;
    distance_[i] = nearest.distance_m;
    towards_x_[i] = nearest.x;
    towards_y_[i] = nearest.y;
    body_[i] = with;
  });
  farthest_m_ = largest(distance_.data(), distance_.size());
}

}  // namespace robosim
