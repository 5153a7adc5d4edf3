#include "geometry/rough_sectors.h"

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

/// Half of what a solid is wide across a direction.
inline float halfWidth(float dx, float dy, const RoughSolid& solid, float round) {
  return solid.half_length_m * std::abs(dy * solid.axis_x - dx * solid.axis_y) +
         solid.half_width_m * std::abs(dx * solid.axis_x + dy * solid.axis_y) + round;
}

ROBOSIM_VECTOR_CLONES
void findMasks(const Arrays& s, std::size_t blocks, const RoughPlace& middle, const RoughSolid* solids,
               const std::uint32_t* indices, std::size_t count, std::uint32_t* __restrict masks) {
  for (std::size_t j = 0; j < count; ++j) {
    const RoughSolid& solid = solids[indices[j]];
    const float x = solid.x - middle.x;
    const float y = solid.y - middle.y;
    const float round = solid.round_m + middle.lost_m;
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
                              (along - halfWidth(-s.axis_y[k], s.axis_x[k], solid, round) <= s.reach[k]);
        bits += may_hold ? kMaskBit[i] : 0;
      }
      *masks++ = bits;
    }
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

void RoughSectors::find(const RoughPlace& middle, const RoughSolid* solids, std::span<const std::uint32_t> indices,
                        std::uint32_t* masks) const {
  findMasks({apex_.x.data(), apex_.y.data(), axis_.x.data(), axis_.y.data(), left_.x.data(), left_.y.data(),
             right_.x.data(), right_.y.data(), reach_.data()},
            blocks(), middle, solids, indices.data(), indices.size(), masks);
}

}  // namespace robosim
