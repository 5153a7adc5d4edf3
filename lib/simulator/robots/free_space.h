#pragma once
#include <cstdint>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "world/world.h"

namespace robosim {

/// Raster of the positions at which a disc touches nothing stationary and lies entirely on the surface. The cell size
/// is half the disc's radius; cells are numbered row by row from the lower left corner.
class FreeSpace {
 public:
  /// @param heights of the disc @throws ConfigError for a world of more than 1e8 cells
  FreeSpace(const World& world, double radius_m, const HeightSpan& heights);

  mrpt::math::TPoint2D place(std::size_t cell) const {
    return {bounds_.x_min + (static_cast<double>(cell % columns_) + 0.5) * cell_m_,
            bounds_.y_min + (static_cast<double>(cell / columns_) + 0.5) * cell_m_};
  }

  double cellSide() const { return cell_m_; }

  /// All free cells reachable from free cells near the starts, in ascending order.
  std::vector<std::size_t> reachableFrom(const std::vector<mrpt::math::TPoint2D>& starts) const;
  /// The largest connected set of free cells, in ascending order; of equal ones that with the lowest cell.
  std::vector<std::size_t> largestRegion() const;
  /// Marks cells that are unknown in the maps as blocked.
  void blockUnknown(const World& world);
  /// Marks cells whose position lies outside a region as blocked.
  void blockOutside(const Bounds2D& region);
  /// Length [m] of the surface's edge that a disc can touch from the given cells and that is not covered by a
  /// stationary solid on it or within a centimetre behind it.
  double openEdge(const std::vector<std::size_t>& cells) const;

 private:
  /// Flood fill: adds the cells reachable from those in `reached` that are not yet `seen`.
  void spread(std::vector<std::uint8_t>& seen, std::vector<std::size_t>& reached) const;
  std::size_t count(double extent_m) const;
  void block(const Outline& outline, double radius_m);
  void closeEdges(const Outline& outline);

  Bounds2D bounds_;
  double radius_m_, cell_m_;
  std::size_t columns_, rows_;
  std::vector<std::uint8_t> free_;
  std::vector<std::uint8_t> left_closed_, right_closed_, bottom_closed_, top_closed_;  ///< by row, by column
};

}  // namespace robosim
