#include "geometry/rough_sectors.h"

#include <algorithm>
#include <cmath>

#include "geometry/vector_clones.h"

namespace robosim {
namespace {

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

/// Looks at all solids for one sector after the other: what is found of each solid gathers in its own lane.
ROBOSIM_VECTOR_CLONES
void findMasks(const Arrays& sectors, std::size_t begin, std::size_t end, const RoughPlace& middle,
               const Candidates::Pack& solids, std::size_t lanes, std::uint32_t* __restrict masks) {
  for (std::size_t k = 0; k < lanes; ++k) masks[k] = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint32_t bit = std::uint32_t{1} << (i - begin);
    const float apex_x = middle.x + sectors.x[i];
    const float apex_y = middle.y + sectors.y[i];
    const float axis_x = sectors.axis_x[i];
    const float axis_y = sectors.axis_y[i];
    const float left_x = sectors.left_x[i];
    const float left_y = sectors.left_y[i];
    const float right_x = sectors.right_x[i];
    const float right_y = sectors.right_y[i];
    const float reach = sectors.reach[i];
    for (std::size_t k = 0; k < lanes; ++k) {
      const float ox = solids.x[k] - apex_x;
      const float oy = solids.y[k] - apex_y;
      const float ux = solids.axis_x[k];
      const float uy = solids.axis_y[k];
      const float half_length = solids.half_length_m[k];
      const float half_width = solids.half_width_m[k];
      const float round = solids.round_m[k] + middle.lost_m;
      // Half of what the solid is wide across the edges, and long along the axis.
      const float right = half_length * std::abs(right_y * ux - right_x * uy) +
                          half_width * std::abs(right_x * ux + right_y * uy) + round;
      const float left =
          half_length * std::abs(left_y * ux - left_x * uy) + half_width * std::abs(left_x * ux + left_y * uy) + round;
      const float deep =
          half_length * std::abs(axis_x * ux + axis_y * uy) + half_width * std::abs(axis_y * ux - axis_x * uy) + round;
      const bool may_hold = (right_x * oy - right_y * ox >= -right) & (ox * left_y - oy * left_x >= -left) &
                            (axis_x * ox + axis_y * oy - deep <= reach);
      masks[k] += may_hold ? bit : 0;
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
  for (std::size_t block = 0; block < blocks(); ++block) {
    findMasks(sectors, block * kBlock, std::min(size_, (block + 1) * kBlock), middle, candidates.pack,
              candidates.lanes(), masks[block].of);
  }
}

}  // namespace robosim
