#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/portable_math.h"
#include "geometry/casting/beam_kernels.h"
#include "geometry/casting/beams.h"
#include "geometry/casting/bearing_cull.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr std::size_t kFewBeams = 32;  ///< maximum for narrow blocks
/// Bound of the rounding error of a direction.
constexpr double kSlack_rad = 1e-9;

double bearingOf(const TPoint2D& direction) { return portable::atan2(direction.y, direction.x); }

std::vector<Sector> toSectors(std::span<const Ray> rays) {
  std::vector<Sector> sectors;
  for (const auto& ray : rays) {
    const TPoint2D direction(ray.direction.x, ray.direction.y);
    sectors.push_back({ray.origin, direction, direction, direction});
  }
  return sectors;
}

TPoint2D computeFacing(std::span<const Sector> sectors) {
  TPoint2D sum;
  for (const auto& sector : sectors) sum += sector.axis;
  if (sum.norm() < 1e-3) return {};
  sum *= 1 / sum.norm();
  const auto is_ahead = [&](const TPoint2D& v) { return sum.x * v.x + sum.y * v.y >= -kSlack_rad; };
  const bool all_ahead = std::all_of(sectors.begin(), sectors.end(), [&](const Sector& sector) {
    return is_ahead(sector.axis) && is_ahead(sector.left) && is_ahead(sector.right);
  });
  return all_ahead ? sum : TPoint2D();
}

double computeHalfWidth(const Sector& sector) {
  const auto angle_to = [&](const TPoint2D& edge) {
    if (edge == sector.axis) return 0.0;  // a ray
    return std::abs(portable::atan2(sector.axis.x * edge.y - sector.axis.y * edge.x,
                                    sector.axis.x * edge.x + sector.axis.y * edge.y));
  };
  return std::max(angle_to(sector.left), angle_to(sector.right));
}

}  // namespace

BeamFan::BeamFan(std::span<const Ray> rays) : BeamFan(toSectors(rays)) { is_wide_ = false; }

BeamFan::BeamFan(std::span<const Sector> sectors) : is_wide_(true) {
  if (sectors.empty()) return;
  const std::size_t count = sectors.size();
  z_m_ = sectors.front().apex.z;
  for (const auto& sector : sectors) middle_ += {sector.apex.x, sector.apex.y};
  middle_ *= 1.0 / static_cast<double>(count);
  for (const auto& sector : sectors) {
    spread_m_ = std::max(spread_m_, (TPoint2D(sector.apex.x, sector.apex.y) - middle_).norm());
    half_width_rad_ = std::max(half_width_rad_, static_cast<float>(computeHalfWidth(sector)));
  }
  facing_ = computeFacing(sectors);

  std::vector<double> bearings_rad;
  for (const auto& sector : sectors) bearings_rad.push_back(bearingOf(sector.axis));
  std::vector<std::uint32_t> by_bearing(count);
  std::iota(by_bearing.begin(), by_bearing.end(), 0U);
  std::sort(by_bearing.begin(), by_bearing.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(bearings_rad[a], a) < std::pair(bearings_rad[b], b);
  });
  slot_.resize(count);
  for (std::uint32_t slot = 0; slot < count; ++slot) slot_[by_bearing[slot]] = slot;
  block_ = count <= kFewBeams ? kNarrowBlock : kWideBlock;
  padded_ = (count + block_ - 1) / block_ * block_;
  const auto add_field = [&](const auto& number_of) {
    for (std::size_t slot = 0; slot < padded_; ++slot) {
      fields_.push_back(number_of(sectors[by_bearing[std::min(slot, count - 1)]]));
    }
  };
  add_field([](const Sector& sector) { return sector.apex.x; });
  add_field([](const Sector& sector) { return sector.apex.y; });
  add_field([](const Sector& sector) { return sector.left.x; });
  add_field([](const Sector& sector) { return sector.left.y; });
  add_field([](const Sector& sector) { return sector.right.x; });
  add_field([](const Sector& sector) { return sector.right.y; });

  first_.resize(2 * kBearingBins + 2, static_cast<std::uint32_t>(padded_ + count));
  for (std::size_t bin = 0, slot = 0; bin < kBearingBins; ++bin) {
    const double from_rad = (static_cast<double>(bin) / kBearingBins * 2 - 1) * M_PI;
    while (bin > 0 && slot < count && bearings_rad[by_bearing[slot]] < from_rad) ++slot;
    first_[bin] = static_cast<std::uint32_t>(slot);
    first_[kBearingBins + bin] = static_cast<std::uint32_t>(padded_ + slot);
  }
}

}  // namespace robosim
