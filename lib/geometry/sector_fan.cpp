#include "geometry/sector_fan.h"

#include <algorithm>

namespace robosim {

SectorFan::SectorFan(std::span<const Sector> sectors) : size_(sectors.size()) {
  if (sectors.empty()) return;
  z_m_ = sectors.front().apex.z;
  for (const auto& sector : sectors) middle_ += {sector.apex.x, sector.apex.y};
  middle_ *= 1.0 / static_cast<double>(size_);
  for (const auto& sector : sectors) {
    spread_m_ = std::max(spread_m_, (mrpt::math::TPoint2D(sector.apex.x, sector.apex.y) - middle_).norm());
  }
  const std::size_t padded = (size_ + kBlock - 1) / kBlock * kBlock;
  for (std::size_t i = 0; i < padded; ++i) {
    const Sector& sector = sectors[std::min(i, size_ - 1)];
    apex_.add(sector.apex.x, sector.apex.y);
    axis_.add(sector.axis.x, sector.axis.y);
    left_.add(sector.left.x, sector.left.y);
    right_.add(sector.right.x, sector.right.y);
  }
}

}  // namespace robosim
