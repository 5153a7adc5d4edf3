#include "geometry/rough_sectors.h"

#include <algorithm>
#include <cmath>

#include "geometry/vector_loops.h"

namespace robosim {
namespace {

constexpr std::size_t kBlock = RoughSectors::kBlock;
static_assert(kBlock <= kMaskBits);

/// Sectors as bare arrays: what the loop below needs to become vector instructions.
struct Arrays {
  const float* __restrict x;
  const float* __restrict y;
  const float* __restrict axis_x;
  const float* __restrict axis_y;
  const float* __restrict left_x;
  const float* __restrict left_y;
  const float* __restrict right_x;
  const float* __restrict right_y;
  const float* __restrict reach;
};

/// A sector, and a solid, as the loops below look at them one by one.
struct RoughSector {
  float x, y, axis_x, axis_y, left_x, left_y, right_x, right_y, reach;
};
struct SolidInView {
  float x, y, axis_x, axis_y, half_length, half_width, round;
};

[[gnu::always_inline]] inline RoughSector sectorAt(const Arrays& s, std::size_t i) {
  return {s.x[i], s.y[i], s.axis_x[i], s.axis_y[i], s.left_x[i], s.left_y[i], s.right_x[i], s.right_y[i], s.reach[i]};
}

[[gnu::always_inline]] inline SolidInView solidAt(const Candidates::Pack& solids, std::size_t k,
                                                  const RoughPlace& middle) {
  return {solids.x[k] - middle.x,
          solids.y[k] - middle.y,
          solids.axis_x[k],
          solids.axis_y[k],
          solids.half_length_m[k],
          solids.half_width_m[k],
          solids.round_m[k] + middle.lost_m};
}

[[gnu::always_inline]] inline bool mayHold(const RoughSector& sector, const SolidInView& solid) {
  const float ox = solid.x - sector.x;
  const float oy = solid.y - sector.y;
  // Half of what the solid is wide across the edges, and long along the axis.
  const auto half = [&](float dx, float dy) __attribute__((always_inline)) {
    return solid.half_length * std::abs(dy * solid.axis_x - dx * solid.axis_y) +
           solid.half_width * std::abs(dx * solid.axis_x + dy * solid.axis_y) + solid.round;
  };
  const bool right_of_left = ox * sector.left_y - oy * sector.left_x >= -half(sector.left_x, sector.left_y);
  const bool left_of_right = sector.right_x * oy - sector.right_y * ox >= -half(sector.right_x, sector.right_y);
  const bool in_reach = sector.axis_x * ox + sector.axis_y * oy - half(-sector.axis_y, sector.axis_x) <= sector.reach;
  return left_of_right & right_of_left & in_reach;
}

/// Of few solids, each is held against all sectors of the block at once.
ROBOSIM_VECTOR_CLONES
void findBySolid(const Arrays& sectors, std::size_t begin, std::size_t end, const RoughPlace& middle,
                 const Candidates::Pack& solids, std::uint32_t* __restrict masks) {
  const std::uint32_t all = (std::uint32_t{1} << (end - begin)) - 1;  // what fills the last block up is none
  for (std::size_t k = 0; k < solids.count; ++k) {
    const SolidInView solid = solidAt(solids, k, middle);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < kBlock; ++i) {
      bits += mayHold(sectorAt(sectors, begin + i), solid) ? kMaskBit[i] : 0;
    }
    masks[k] = bits & all;
  }
}

/// Of many, all are held against one sector at once: what is found of each gathers in its own lane.
ROBOSIM_VECTOR_CLONES
void findBySector(const Arrays& sectors, std::size_t begin, std::size_t end, const RoughPlace& middle,
                  const Candidates::Pack& solids, std::size_t lanes, std::uint32_t* __restrict masks) {
  for (std::size_t k = 0; k < lanes; ++k) masks[k] = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint32_t bit = std::uint32_t{1} << (i - begin);
    const RoughSector sector = sectorAt(sectors, i);
    for (std::size_t k = 0; k < lanes; ++k) masks[k] += mayHold(sector, solidAt(solids, k, middle)) ? bit : 0;
  }
}

ROBOSIM_VECTOR_CLONES
void turn(const double* __restrict x, const double* __restrict y, std::size_t count, double x0, double y0, double cos,
          double sin, float* __restrict to_x, float* __restrict to_y) {
  for (std::size_t i = 0; i < count; ++i) {
    to_x[i] = static_cast<float>(cos * (x[i] - x0) - sin * (y[i] - y0));
    to_y[i] = static_cast<float>(sin * (x[i] - x0) + cos * (y[i] - y0));
  }
}

}  // namespace

void RoughSectors::place(const SectorFan& fan, const LevelFrame& frame, double range_m) {
  size_ = fan.size();
  const std::size_t count = fan.axis_.x.size();
  const auto set = [&](Vectors& to, const SectorFan::Vectors& from, const mrpt::math::TPoint2D& seen_from) {
    to.x.resize(count);
    to.y.resize(count);
    turn(from.x.data(), from.y.data(), count, seen_from.x, seen_from.y, frame.cos(), frame.sin(), to.x.data(),
         to.y.data());
  };
  set(apex_, fan.apex_, fan.middle());
  set(axis_, fan.axis_, {});
  set(left_, fan.left_, {});
  set(right_, fan.right_, {});
  reach_.assign(count, static_cast<float>(range_m));
}

void RoughSectors::find(const RoughPlace& middle, const Candidates& candidates,
                        std::span<Candidates::Masks> masks) const {
  const Arrays sectors{apex_.x.data(), apex_.y.data(),  axis_.x.data(),  axis_.y.data(), left_.x.data(),
                       left_.y.data(), right_.x.data(), right_.y.data(), reach_.data()};
  constexpr std::size_t kFew = 8;
  for (std::size_t block = 0; block < blocks(); ++block) {
    const std::size_t begin = block * kBlock;
    const std::size_t end = std::min(size_, begin + kBlock);
    if (candidates.pack.count < kFew) {
      findBySolid(sectors, begin, end, middle, candidates.pack, masks[block].of);
    } else {
      findBySector(sectors, begin, end, middle, candidates.pack, candidates.lanes(), masks[block].of);
    }
  }
}

}  // namespace robosim
