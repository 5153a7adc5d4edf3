#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "geometry/shapes/solid.h"
#include "world/geo_position.h"
#include "world/occupancy_grid.h"

namespace robosim {

/// Rectangle of occupied cells.
struct CellRectangle {
  std::uint32_t column = 0, row = 0;    ///< of the lower left cell
  std::uint32_t columns = 1, rows = 1;  ///< number of columns and rows
  bool operator==(const CellRectangle&) const = default;
};

/// A rectangle of any orientation.
struct PlanBox {
  mrpt::math::TPose2D map_from_box;  ///< of its centre
  double length_m = 0;               ///< along its x axis
  double width_m = 0;
  bool operator==(const PlanBox&) const = default;
};

/// Contents of a map file, independent of its format, in the map's frame.
struct FloorPlan {
  std::uint32_t columns = 0, rows = 0;  ///< number of cells; 0 when the map has none
  double cell_m = 0;
  mrpt::math::TPose2D map_from_grid;    ///< of the lower left corner of the first cell
  std::vector<CellRectangle> occupied;  ///< all occupied cells, each in one rectangle
  std::vector<CellRectangle> unknown;   ///< all unknown cells that are not taken for occupied, each in one rectangle
  std::vector<PlanBox> boxes;           ///< obstacles that are not given as cells
  std::vector<mrpt::math::TPose2D> starts;  ///< start poses given by the map, best first
  std::optional<GeoPosition> origin;        ///< of the map's frame on the earth; its x axis points east
  std::vector<std::string> warnings;        ///< contents that are probably not intended, for the author of the map
  bool operator==(const FloorPlan&) const = default;

  std::uint64_t occupiedCells() const;
};

/// Merges occupied cells into rectangles: runs within a row first, then equal runs of consecutive rows. Rows must be
/// added in ascending order, and the runs of a row from left to right with a gap between any two.
class CellMerger {
 public:
  void add(std::uint32_t row, std::uint32_t first_column, std::uint32_t end_column);
  std::vector<CellRectangle> finish();

 private:
  void closeRow();

  std::vector<CellRectangle> done_;
  std::vector<CellRectangle> below_;  ///< rectangles that the current row may extend, from left to right
  std::vector<CellRectangle> here_;   ///< runs of the current row, with the rectangles that they extend
  std::uint32_t row_ = 0;
};

/// @param unknown_is_occupied whether unknown cells become occupied; otherwise they become free
FloorPlan toFloorPlan(const OccupancyGrid&, bool unknown_is_occupied);

/// Bounding rectangle in the world of the whole map including its free cells; a point for an empty map.
Bounds2D boundsOf(const FloorPlan&, const mrpt::math::TPose2D& world_from_map);

/// Distance [m], about a nanometre, by which the solids of cells and boxes extend over their edges, so that no ray
/// passes between two touching solids because of rounding.
double computeSeam(const FloorPlan&, const mrpt::math::TPose2D& world_from_map);

/// Appends the obstacles as solids: a box for every rectangle of cells and for every box.
void addSolids(const FloorPlan&, const mrpt::math::TPose2D& world_from_map, const HeightSpan& heights,
               std::vector<Solid>& solids);

}  // namespace robosim
