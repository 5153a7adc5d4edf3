#include <algorithm>
#include <limits>

#include "base/vector_width.h"
#include "geometry/casting/beam_kernels.h"
#include "geometry/casting/beams.h"
#include "geometry/casting/bearing_cull.h"

namespace robosim {
namespace {

/// Bound [m] of the rounding error of a solid's distance.
constexpr double kSlack_m = 1e-9;

/// Blocks of beams.
struct Blocks {
  const std::uint32_t* first;  ///< as in the fan
  std::size_t count;
};

/// The largest of `count` numbers; `count` must be a positive multiple of four.
[[gnu::always_inline]] inline double largest(const double* numbers, std::size_t count) {
  double lane_max[4] = {numbers[0], numbers[1], numbers[2], numbers[3]};
  for (std::size_t i = 4; i < count; i += 4) {
    for (std::size_t j = 0; j < 4; ++j) lane_max[j] = numbers[i + j] > lane_max[j] ? numbers[i + j] : lane_max[j];
  }
  return std::max(std::max(lane_max[0], lane_max[1]), std::max(lane_max[2], lane_max[3]));
}

/// Intersects the chosen candidates with the blocks of beams that they may hit.
template <auto kIntersect, std::size_t kBlock>
[[gnu::always_inline]] inline void intersectChosen(const Beams& beams, const Blocks& blocks,
                                                   const Candidates& candidates, const BearingArrays& arrays,
                                                   const std::uint8_t* chosen, std::size_t count) {
  for (std::size_t j = 0; j < count; ++j) {
    const std::size_t k = chosen[j];
    const std::uint32_t begin = blocks.first[arrays.first[k]];
    const std::uint32_t end = blocks.first[arrays.last[k] + 1];
    const GridItem& item = *candidates.item[k];
    const double body = candidates.body[k];
    if constexpr (kBlock > kNarrowBlock) {
      const std::size_t from = begin / kBlock * kBlock;
      const std::size_t to = (end + kBlock - 1) / kBlock * kBlock;
      const bool is_one_range = begin < end && to <= blocks.count * kBlock;
      if (is_one_range && largest(beams.distance + from, to - from) < arrays.nearest[k]) continue;  // hidden
    }
    for (std::uint32_t block = begin / kBlock; block * kBlock < end; ++block) {
      // Slots from `beams` on are the first ones again.
      const std::size_t at = block < blocks.count ? block : block - blocks.count;
#pragma GCC unroll 1  // unrolled, the loop would not be vectorised
      for (std::size_t i = at * kBlock; i < at * kBlock + kBlock; ++i) kIntersect(beams, i, item, body);
    }
  }
}

/// Intersects candidates with all beams that may hit them.
template <typename Kernel, std::size_t kBlock>
[[gnu::always_inline]] inline void intersectAll(Beams beams, const CullFrame* frame, double z_m, Blocks blocks,
                                                const Candidates* candidates) {
  static thread_local BearingArrays arrays;
  gather(*candidates, *frame, arrays);
  // The covering disc suffices for wide gaps between beams.
  findBins<kBlock == kNarrowBlock>(*frame, candidates->count, arrays);
  // Sorted by shape without branches, because the shape is unpredictable.
  std::uint8_t circles[Candidates::kCapacity], boxes[Candidates::kCapacity];
  std::size_t circle_count = 0, box_count = 0;
  for (std::size_t k = 0; k < candidates->count; ++k) {
    const GridItem& item = *candidates->item[k];
    const std::size_t fits = (item.heights.z_min_m <= z_m) & (z_m <= item.heights.z_max_m) &
                             !(arrays.nearest[k] > frame->reach_m);  // also for NaN
    const std::size_t is_circle = item.isCircle();
    circles[circle_count] = boxes[box_count] = static_cast<std::uint8_t>(k);
    circle_count += fits & is_circle;
    box_count += fits & (1 - is_circle);
  }
  intersectChosen<Kernel::circle, kBlock>(beams, blocks, *candidates, arrays, circles, circle_count);
  intersectChosen<Kernel::box, kBlock>(beams, blocks, *candidates, arrays, boxes, box_count);
}

/// Rotates points or directions about the origin and translates them by (x0, y0).
[[gnu::always_inline]] inline void transform(const double* __restrict x, const double* __restrict y, std::size_t count,
                                             double x0, double y0, double cos, double sin, double* __restrict to_x,
                                             double* __restrict to_y) {
  for (std::size_t i = 0; i < count; ++i) {
    to_x[i] = x0 + cos * x[i] - sin * y[i];
    to_y[i] = y0 + sin * x[i] + cos * y[i];
  }
}

}  // namespace

void BeamBatch::place(const BeamFan& fan, const PlanarTransform& world_from_fan, double range_m, double pan_rad) {
  fan_ = &fan;
  world_from_fan_ = world_from_fan;
  panned_ = PlanarTransform(world_from_fan, pan_rad);
  moved_ = {};
  turned_rad_ = 0;
  is_initialized_ = false;
  center_ = world_from_fan.pointToWorld(fan.middle_);
  facing_ = panned_.turnToWorld(fan.facing_);
  z_m_ = world_from_fan.z() + fan.z_m_;
  spread_m_ = fan.spread_m_ + kSlack_m;
  farthest_m_ = range_m;
}

void BeamBatch::placeMoved(const BeamFan& fan, const PlanarTransform& world_from_fan, double range_m, double pan_rad,
                           const MovedRays& moved) {
  place(fan, world_from_fan, range_m, pan_rad);
  moved_ = moved.rays;
  turned_rad_ = moved.turn_rad + kSlack_m;
  spread_m_ += moved.shift_m;
  if (moved.turn_rad > 0) facing_ = {};
}

void BeamBatch::initialize() {
  is_initialized_ = true;
  const BeamFan& fan = *fan_;
  const std::size_t count = fan.origin_.x.size();
  if (distance_.size() != count) {
    for (auto* field : {&origin_, &left_, &right_, &towards_}) {
      field->x.resize(count);
      field->y.resize(count);
    }
  }
  const auto turn = [&](const BeamFan::Vectors& from, double x0, double y0, const PlanarTransform& by,
                        BeamFan::Vectors& to) {
    withVectors<transform>(from.x.data(), from.y.data(), count, x0, y0, by.cos(), by.sin(), to.x.data(), to.y.data());
  };
  turn(fan.origin_, world_from_fan_.x(), world_from_fan_.y(), world_from_fan_, origin_);
  turn(fan.left_, 0, 0, panned_, left_);
  if (fan.is_wide_) turn(fan.right_, 0, 0, panned_, right_);
  for (std::size_t i = 0; i < moved_.size(); ++i) {
    const std::size_t slot = fan.slot_[i];
    origin_.x[slot] = moved_[i].origin.x;
    origin_.y[slot] = moved_[i].origin.y;
    left_.x[slot] = moved_[i].direction.x;
    left_.y[slot] = moved_[i].direction.y;
  }
  distance_.assign(count, farthest_m_);
  body_.assign(count, kNothing);
  // The padding of the last group never hits anything.
  std::fill(distance_.begin() + static_cast<std::ptrdiff_t>(size()), distance_.end(),
            -std::numeric_limits<double>::max());
}

void BeamBatch::intersect(const Candidates& candidates) {
  if (!is_initialized_) initialize();
  const Beams beams{origin_.x.data(), origin_.y.data(), left_.x.data(), left_.y.data(),    right_.x.data(),
                    right_.y.data(),  distance_.data(), body_.data(),   towards_.x.data(), towards_.y.data()};
  const CullFrame frame{center_.x,
                        center_.y,
                        static_cast<float>(panned_.cos()),
                        static_cast<float>(panned_.sin()),
                        static_cast<float>(spread_m_ * (1 + kCullRelativeError)),
                        fan_->half_width_rad_ + static_cast<float>(turned_rad_),
                        static_cast<float>(farthest_m_)};
  const Blocks blocks{fan_->first_.data(), distance_.size() / fan_->block_};
  const auto intersect = [&](auto kernel) {
    using Kernel = decltype(kernel);
    if (fan_->block_ == kNarrowBlock) {
      withVectors<intersectAll<Kernel, kNarrowBlock>>(beams, &frame, z_m_, blocks, &candidates);
    } else {
      withVectors<intersectAll<Kernel, kWideBlock>>(beams, &frame, z_m_, blocks, &candidates);
    }
  };
  if (fan_->is_wide_) {
    intersect(SectorKernel());
  } else {
    intersect(RayKernel());
  }
  farthest_m_ = largest(distance_.data(), distance_.size());
}

}  // namespace robosim
