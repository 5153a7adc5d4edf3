#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <memory>

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
  DoubleQuad lane_max;
  std::memcpy(&lane_max, numbers, sizeof lane_max);
  for (std::size_t i = 4; i < count; i += 4) {
    DoubleQuad next;
    std::memcpy(&next, numbers + i, sizeof next);
    lane_max = next > lane_max ? next : lane_max;
  }
  return std::max(std::max(lane_max[0], lane_max[1]), std::max(lane_max[2], lane_max[3]));
}

/// Intersects the chosen candidates with the blocks of beams that they may hit.
template <auto kIntersect, std::size_t kBlock>
[[gnu::always_inline]] inline void intersectChosen(const Beams& beams, const Blocks& blocks,
                                                   const Candidates& candidates, const BearingArrays& arrays,
                                                   std::uint32_t chosen) {
  for (; chosen != 0; chosen &= chosen - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(chosen));
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
/// @return the largest distance of all beams
template <typename Kernel, std::size_t kBlock>
[[gnu::always_inline]] inline double intersectAll(Beams beams, const CullFrame* frame, double z_m, Blocks blocks,
                                                  const Candidates* candidates, BearingArrays* bearings) {
  BearingArrays& arrays = *bearings;
  // The covering disc suffices for wide gaps between beams.
  constexpr bool kDisc = kBlock == kNarrowBlock;
  const CandidatesByShape shapes = gather<kDisc>(*candidates, *frame, z_m, arrays);
  const std::uint32_t far = findBins<kDisc>(*frame, candidates->count, arrays);
  // By shape, because the shape is unpredictable.
  intersectChosen<Kernel::circle, kBlock>(beams, blocks, *candidates, arrays, shapes.circles & ~far);
  intersectChosen<Kernel::box, kBlock>(beams, blocks, *candidates, arrays, shapes.boxes & ~far);
  return largest(beams.distance, blocks.count * kBlock);
}

/// Rotates directions.
[[gnu::always_inline]] inline void turn(const double* __restrict x, const double* __restrict y, std::size_t count,
                                        double cos, double sin, double* __restrict to_x, double* __restrict to_y) {
  for (std::size_t i = 0; i < count; ++i) {
    to_x[i] = cos * x[i] - sin * y[i];
    to_y[i] = sin * x[i] + cos * y[i];
  }
}

/// Transforms the origins and the left edges of beams, which have no hit yet.
[[gnu::always_inline]] inline void placeBeams(const double* __restrict x, const double* __restrict y,
                                              const double* __restrict left_x, const double* __restrict left_y,
                                              std::size_t count, const PlanarTransform* world_from_fan,
                                              const PlanarTransform* panned, double range_m, double* __restrict to_x,
                                              double* __restrict to_y, double* __restrict to_left_x,
                                              double* __restrict to_left_y, double* __restrict distance,
                                              double* __restrict body) {
  const PlanarTransform at = *world_from_fan;
  const double cos = panned->cos(), sin = panned->sin();
  for (std::size_t i = 0; i < count; ++i) {
    to_x[i] = at.x() + at.cos() * x[i] - at.sin() * y[i];
    to_y[i] = at.y() + at.sin() * x[i] + at.cos() * y[i];
    to_left_x[i] = cos * left_x[i] - sin * left_y[i];
    to_left_y[i] = sin * left_x[i] + cos * left_y[i];
    distance[i] = range_m;
    body[i] = static_cast<double>(BeamBatch::kNothing);
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
    distance_.resize(count);
    body_.resize(count);
  }
  withVectors<placeBeams>(fan.origin_.x.data(), fan.origin_.y.data(), fan.left_.x.data(), fan.left_.y.data(), count,
                          &world_from_fan_, &panned_, farthest_m_, origin_.x.data(), origin_.y.data(), left_.x.data(),
                          left_.y.data(), distance_.data(), body_.data());
  if (fan.is_wide_) {
    withVectors<turn>(fan.right_.x.data(), fan.right_.y.data(), count, panned_.cos(), panned_.sin(), right_.x.data(),
                      right_.y.data());
  }
  for (std::size_t i = 0; i < moved_.size(); ++i) {
    const std::size_t slot = fan.slot_[i];
    origin_.x[slot] = moved_[i].origin.x;
    origin_.y[slot] = moved_[i].origin.y;
    left_.x[slot] = moved_[i].direction.x;
    left_.y[slot] = moved_[i].direction.y;
  }
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
  // On the heap, because the compiler treats each access to a thread's variable as a call, around which it spills the
  // vectors of its loops.
  static thread_local const auto arrays = std::make_unique<BearingArrays>();
  const auto intersect = [&](auto kernel) {
    using Kernel = decltype(kernel);
    return fan_->block_ == kNarrowBlock
               ? withVectors<intersectAll<Kernel, kNarrowBlock>>(beams, &frame, z_m_, blocks, &candidates, arrays.get())
               : withVectors<intersectAll<Kernel, kWideBlock>>(beams, &frame, z_m_, blocks, &candidates, arrays.get());
  };
  farthest_m_ = fan_->is_wide_ ? intersect(SectorKernel()) : intersect(RayKernel());
}

}  // namespace robosim
