#include "geometry/index/neighbour_list.h"

#include <algorithm>
#include <bit>

namespace robosim {
namespace {

/// Several steps of a fast robot, yet small enough that the list stays short.
constexpr double kSkin_m = 0.7;
/// Where more solids lie within reach, the nearest ones occlude most of the others.
constexpr std::size_t kMaxNeighbours = 64;
static_assert(kMaxNeighbours <= std::numeric_limits<std::uint8_t>::max());
/// Slightly less than 1: the product never increases when rounded to float.
constexpr double kRoundDown = 1 - 1e-7;

}  // namespace

void NeighbourList::update(const GridIndex& solids, const mrpt::math::TPoint2D& at, double reach_m) {
  if (driftTo(at) <= kSkin_m) return;
  // Packs distance and index into one integer that sorts by distance: the bits of non-negative floats are ordered like
  // the floats.
  static thread_local std::vector<std::uint64_t> found;
  anchor_ = at;
  const double covered_m = reach_m + kSkin_m;
  covered_m_ = static_cast<float>(covered_m * kRoundDown);
  std::size_t count = 0;
  const GridItem* const items = solids.items().data();
  solids.visitNear(at, covered_m, [&](std::uint32_t i) {
    const double nearest_m = items[i].distanceTo(at);
    const auto rounded_m = static_cast<float>(nearest_m * kRoundDown);
    if (count == found.size()) found.resize(2 * count + 64);
    found[count] = std::uint64_t{std::bit_cast<std::uint32_t>(rounded_m)} << 32 | i;
    count += nearest_m <= covered_m ? 1 : 0;  // branch-free, because the condition is unpredictable
  });
  const auto begin = found.begin();
  std::sort(begin, begin + static_cast<std::ptrdiff_t>(count));
  const auto end = std::unique(begin, begin + static_cast<std::ptrdiff_t>(count));
  const auto distance = [](std::uint64_t key) { return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32)); };
  const std::size_t kept = std::min(static_cast<std::size_t>(end - begin), kMaxNeighbours);
  if (begin + static_cast<std::ptrdiff_t>(kept) != end) covered_m_ = distance(found[kept]);
  if (kept > capacity_) {
    nearest_first_ = std::make_unique_for_overwrite<Neighbour[]>(kept);
    capacity_ = static_cast<std::uint8_t>(kept);
  }
  size_ = static_cast<std::uint8_t>(kept);
  for (std::size_t k = 0; k < kept; ++k) {
    nearest_first_[k] = {distance(found[k]), static_cast<std::uint32_t>(found[k])};
  }
}

}  // namespace robosim
