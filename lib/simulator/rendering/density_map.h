#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <opencv2/core/mat.hpp>

#include "geometry/shapes/solid.h"
#include "rendering/color.h"
#include "rendering/run_paths.h"
#include "robots/fleet.h"
#include "robots/run_snapshot.h"
#include "robots/view_layers.h"
#include "world/world.h"

namespace robosim {

/// Robots or visits per area, counted in square cells over a world's bounds, with a scale of eight colours from 0 to a
/// round number. A visit is the entry of a robot's centre into a cell; the cell where its path begins counts as
/// entered, a robot that stands does not count again.
class DensityMap {
 public:
  enum class Quantity { robots, visits };
  static constexpr int kLevels = 8;

  /// @param cell_m side of the cells; the first has its corner at the lower left of the area
  DensityMap(Quantity quantity, const Bounds2D& area, double cell_m);

  /// Side of the cells [m], a round number (1, 2, 5, …): at most 150 cells on the longer side, no cell smaller than a
  /// robot, and with robots at least 2 of them to a cell on average, as far as there are 8 cells on the longer side.
  /// @param robots number of the counted robots; 0 for visits
  static double cellSide(const Bounds2D& area, std::size_t robots, double radius_max_m);

  /// Counts a robot. Positions outside the area are left out.
  void addRobot(const mrpt::math::TPoint2D& at);
  /// Counts the cells that a path of straight pieces enters. Pieces are separated by kPathGap, after which the path
  /// enters a cell again.
  void addPath(std::span<const mrpt::math::TPoint2D> path);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double cell() const { return cell_m_; }  ///< side [m]
  /// Robots or visits [1/m²]; row 0 is the lowest.
  double perSquareMetre(int column, int row) const;
  /// End of the scale [1/m²]: the smallest round number (1, 2, 5, …) that at most 1 of 100 non-empty cells exceeds.
  double top() const;
  /// Level of a density on the scale: 0 for an empty cell, else 1 to kLevels; kLevels also beyond the scale.
  static int levelOf(double per_square_metre, double top);
  /// Levels of all cells, 8 bits; row 0 is the highest, as in a picture.
  cv::Mat levels() const;
  /// Upper left corner of the cells, world frame.
  mrpt::math::TPoint2D upperLeft() const { return {low_.x, low_.y + rows_ * cell_m_}; }
  /// "0 to 0.5 robots/m²", with a "+" at the end when cells exceed the scale.
  std::string legend() const;

  /// Colour of a level from 1 to kLevels: from light to dark, so that the order is visible also without colour vision
  /// and in grey.
  static Color colorOf(int level);

 private:
  std::optional<std::size_t> cellAt(const mrpt::math::TPoint2D& at) const;
  void addPiece(const mrpt::math::TPoint2D& from, const mrpt::math::TPoint2D& to, std::optional<std::size_t>& cell);

  Quantity quantity_;
  mrpt::math::TPoint2D low_;  ///< lower left corner
  double cell_m_;
  int columns_, rows_;
  std::vector<std::uint32_t> counts_;  ///< row by row
};

/// The map that layers ask for, of the robots that they show; nullopt for none.
/// @param at positions by robot; nullopt for absent ones @param paths by robot; pieces separated by kPathGap
std::optional<DensityMap> densityOf(const ViewLayers& layers, const World& world, const Fleet& fleet,
                                    std::span<const std::optional<mrpt::math::TPoint2D>> at,
                                    std::span<const std::vector<mrpt::math::TPoint2D>> paths);
/// The same of a snapshot and the paths before.
std::optional<DensityMap> densityOf(const ViewLayers& layers, const World& world, const Fleet& fleet,
                                    const RunSnapshot& snapshot, const RunPaths& paths);

}  // namespace robosim
