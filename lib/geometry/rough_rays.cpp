// Compiled so that a product and a sum become one instruction where the processor has it (lib/CMakeLists.txt): what is
// found here decides nothing but who is looked at closely.
#include "geometry/rough_rays.h"

#include "geometry/rough_solid.h"
#include "geometry/vector_clones.h"

namespace robosim {
namespace {

/// Bit i for solid i of a pack.
constexpr PackMarks kPackBits = {1, 2, 4, 8, 16, 32, 64, 128};

}  // namespace

ROBOSIM_VECTOR_CLONES
void RoughRays::set(const RayWalks& walks, const mrpt::math::TPoint2D& middle) {
  const mrpt::math::TPoint2D here = middle;  // which nothing below can change, as far as the compiler can tell
  for (std::size_t i = 0; i < RayWalks::kMost; ++i) {
    const auto from = RoughPlace::from({walks.x[i], walks.y[i]}, 0, here);
    x_[i] = from.x;
    y_[i] = from.y;
    lost_m_[i] = from.lost_m;
    dx_[i] = static_cast<float>(walks.dx[i]);
    dy_[i] = static_cast<float>(walks.dy[i]);
  }
}

ROBOSIM_VECTOR_CLONES
void RoughRays::findPassed(const RayWalks& walks, const GridIndex::Pack* packs, Passed& passed) const {
  constexpr std::size_t kInMarks = 4;  // rays that have room in a number of PackMarks
  static_assert(RayWalks::kTogether == 2 * kInMarks && GridIndex::Pack::kMost == 8);
  for (std::size_t first = 0; first < walks.going_count; first += kInMarks) {
    PackMarks marks = {};
    for (std::size_t k = 0; k < kInMarks; ++k) {
      const std::uint32_t i = walks.going[first + k];
      PackMarks passed_by_one;
      lookAt(ray(i), packs[walks.pack[i]], static_cast<float>(walks.reach_m[i]), passed_by_one);
      marks |= passed_by_one & (kPackBits << static_cast<std::int32_t>(8 * k));
    }
    const std::uint64_t before = first % RayWalks::kTogether == 0 ? 0 : passed[first / RayWalks::kTogether];
    passed[first / RayWalks::kTogether] = before | std::uint64_t{together(marks)}
                                                       << (8 * (first % RayWalks::kTogether));
  }
  const std::size_t over = walks.going_count % RayWalks::kTogether;
  if (over != 0) passed[walks.going_count / RayWalks::kTogether] &= (std::uint64_t{1} << (8 * over)) - 1;
}

}  // namespace robosim
