#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <memory>
#include <type_traits>

#include "base/quads.h"
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
template <auto kIntersect, std::size_t kBlock, typename Beams>
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
/// @param beams passed by value: the compiler heeds restrict pointers of parameters only
/// @return the largest distance of all beams
template <typename Kernel, std::size_t kBlock>
[[gnu::always_inline]] inline double intersectAll(typename Kernel::Beams beams, std::size_t padded,
                                                  const CullFrame* frame, double z_m, const std::uint32_t* first_of_bin,
                                                  const Candidates* candidates, BearingArrays* bearings) {
  const Blocks blocks{first_of_bin, padded / kBlock};
  BearingArrays& arrays = *bearings;
  // The covering disc suffices for wide gaps between beams.
  constexpr bool kDisc = kBlock == kNarrowBlock;
  const CandidatesByShape shapes = gather<kDisc>(*candidates, *frame, z_m, arrays);
  const std::uint32_t far = findBins<kDisc>(*frame, candidates->count, arrays);
  // By shape, because the shape is unpredictable.
  intersectChosen<Kernel::circle, kBlock>(beams, blocks, *candidates, arrays, shapes.circles & ~far);
  intersectChosen<Kernel::box, kBlock>(beams, blocks, *candidates, arrays, shapes.boxes & ~far);
  return largest(beams.distance, padded);
}

/// Rotates vectors.
/// @param x,to_x fields, each followed by that of y after `padded` numbers
[[gnu::always_inline]] inline void turnFour(const double* x, std::size_t padded, double cos, double sin, double* to_x) {
  DoubleQuad from_x, from_y;
  loadFour(x, from_x);
  loadFour(x + padded, from_y);
  storeFour(cos * from_x - sin * from_y, to_x);
  storeFour(sin * from_x + cos * from_y, to_x + padded);
}

/// Transforms the origins and the edges of beams, which have no hit yet.
/// @param from fields of the fan, each of `padded` numbers @param to BeamBatch::Field
template <bool kIsWide>
[[gnu::always_inline]] inline void placeBeams(const double* from, std::size_t padded,
                                              const PlanarTransform* world_from_fan, const PlanarTransform* panned,
                                              double range_m, double* to) {
  const PlanarTransform at = *world_from_fan;
  const double cos = panned->cos(), sin = panned->sin();
  const DoubleQuad range{range_m, range_m, range_m, range_m};
  constexpr auto kNothing = static_cast<double>(BeamBatch::kNothing);
  const DoubleQuad nothing{kNothing, kNothing, kNothing, kNothing};
  for (std::size_t i = 0; i < padded; i += 4) {
    DoubleQuad x, y;
    loadFour(from + i, x);
    loadFour(from + padded + i, y);
    storeFour(at.x() + at.cos() * x - at.sin() * y, to + i);
    storeFour(at.y() + at.sin() * x + at.cos() * y, to + padded + i);
    turnFour(from + 2 * padded + i, padded, cos, sin, to + 2 * padded + i);
    if constexpr (kIsWide) turnFour(from + 4 * padded + i, padded, cos, sin, to + 4 * padded + i);
    storeFour(range, to + 6 * padded + i);
    storeFour(nothing, to + 7 * padded + i);
  }
}

}  // namespace

BeamBatch::BeamBatch() : arrays_(std::make_unique<BearingArrays>()) {}
BeamBatch::~BeamBatch() = default;

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
  const std::size_t padded = fan.padded_;
  const std::size_t size = padded * static_cast<std::size_t>(Field::count);
  if (fields_.size() < size) fields_.resize(size);
  if (fan.is_wide_) {
    withVectors<placeBeams<true>>(fan.fields_.data(), padded, &world_from_fan_, &panned_, farthest_m_, fields_.data());
  } else {
    withVectors<placeBeams<false>>(fan.fields_.data(), padded, &world_from_fan_, &panned_, farthest_m_, fields_.data());
  }
  for (std::size_t i = 0; i < moved_.size(); ++i) {
    const std::size_t slot = fan.slot_[i];
    field(Field::x)[slot] = moved_[i].origin.x;
    field(Field::y)[slot] = moved_[i].origin.y;
    field(Field::left_x)[slot] = moved_[i].direction.x;
    field(Field::left_y)[slot] = moved_[i].direction.y;
  }
  // The padding of the last group never hits anything.
  double* const distances_m = field(Field::distance);
  for (std::size_t slot = fan.size(); slot < padded; ++slot) distances_m[slot] = -std::numeric_limits<double>::max();
}

void BeamBatch::intersect(Candidates& candidates) {
  if (!is_initialized_) initialize();
  candidates.pad();
  const CullFrame frame{center_.x,
                        center_.y,
                        static_cast<float>(panned_.cos()),
                        static_cast<float>(panned_.sin()),
                        static_cast<float>(spread_m_ * (1 + kCullRelativeError)),
                        fan_->half_width_rad_ + static_cast<float>(turned_rad_),
                        static_cast<float>(farthest_m_)};
  const auto intersect = [&]<typename Kernel>() {
    const auto with = [&](auto block) {
      const typename Kernel::Beams beams(fields_.data(), fan_->padded_);
      return withVectors<intersectAll<Kernel, block()>>(beams, fan_->padded_, &frame, z_m_, fan_->first_.data(),
                                                        static_cast<const Candidates*>(&candidates), arrays_.get());
    };
    return fan_->block_ == kNarrowBlock ? with(std::integral_constant<std::size_t, kNarrowBlock>())
                                        : with(std::integral_constant<std::size_t, kWideBlock>());
  };
  farthest_m_ =
      fan_->is_wide_ ? intersect.template operator()<SectorKernel>() : intersect.template operator()<RayKernel>();
}

}  // namespace robosim
