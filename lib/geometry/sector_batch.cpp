#include "geometry/sector_batch.h"

#include <algorithm>
#include <cmath>

#include "geometry/vector_loops.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr std::size_t kBlock = SectorFan::kBlock;
/// More than rounding may make of any of the lengths here [m].
constexpr double kSlack_m = 1e-9;

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
  rough_.place(fan, frame, range_m);
  holding_.resize(rough_.blocks());
  distance_.assign(count, range_m);
  body_.assign(count, kNothing);
  towards_x_.resize(count);
  towards_y_.resize(count);
}

void SectorBatch::meet(const Candidates& candidates) {
  rough_.find(RoughPlace::from(center_, spread_m_, candidates.middle), candidates, holding_);
  for (std::size_t block = 0; block < rough_.blocks(); ++block) {
    const auto first = static_cast<std::uint32_t>(block * kBlock);
    candidates.forEachMark(holding_[block], z_m_, first, [&](const GridItem& item, std::int64_t body, std::uint32_t i) {
      pairs_.add(item, body, i, item.x - apex_.x[i], item.y - apex_.y[i], {left_.x[i], left_.y[i]},
                 {right_.x[i], right_.y[i]});
      if (pairs_.isFull()) settle();
    });
  }
}

void SectorBatch::settle() {
  pairs_.settle([&](std::uint32_t i, const SectorPairs::Nearest& nearest, std::int64_t with) {
    // As near, the one of the lower number: so the order of solids does not matter.
    const bool keeps = nearest.distance_m < distance_[i] || (nearest.distance_m == distance_[i] && with < body_[i]);
    if (!keeps) return;
    distance_[i] = nearest.distance_m;
    rough_.setReach(i, nearest.distance_m);
    towards_x_[i] = nearest.x;
    towards_y_[i] = nearest.y;
    body_[i] = with;
  });
  farthest_m_ = largest(distance_.data(), distance_.size());
}

}  // namespace robosim
