#pragma once
#include <cstdint>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "geometry/solid.h"
#include "world/occupancy_grid.h"

namespace robosim {

/// Cells side by side, all of them occupied.
struct CellRectangle {
  std::uint32_t column = 0, row = 0;    ///< of the lower left one
  std::uint32_t columns = 1, rows = 1;  ///< how many
  bool operator==(const CellRectangle&) const = default;
};

/// A rectangle of any direction.
struct PlanBox {
  mrpt::math::TPose2D map_from_box;  ///< of its centre
  double length_m = 0;               ///< along its x axis
  double width_m = 0;
  bool operator==(const PlanBox&) const = default;
};

/// What a map file says, whatever its format: where something stands. Plain values, in the map's own frame.
struct FloorPlan {
  std::uint32_t columns = 0, rows = 0;  ///< of the cells; 0 when the map has none
  double cell_m = 0;
  mrpt::math::TPose2D map_from_grid;        ///< of the lower left corner of the first cell
  std::vector<CellRectangle> occupied;      ///< all occupied cells, each in one rectangle
  std::vector<PlanBox> boxes;               ///< what is told otherwise than by cells
  std::vector<mrpt::math::TPose2D> starts;  ///< where the map says that a robot may start, the best first
  bool operator==(const FloorPlan&) const = default;

  std::uint64_t occupiedCells() const;
};

/// Joins cells to rectangles: runs within a row first, then equal runs of rows one above the other. Takes the rows in
/// ascending order, and the runs of a row from left to right with a gap between any two.
class CellMerger {
 public:
  void add(std::uint32_t row, std::uint32_t first_column, std::uint32_t end_column);
  std::vector<CellRectangle> finish();

 private:
  void closeRow();

  std::vector<CellRectangle> done_;
  std::vector<CellRectangle> below_;  ///< that may go on in the row at hand, from left to right
  std::vector<CellRectangle> here_;   ///< runs of the row at hand, with what they go on from
  std::uint32_t row_ = 0;
};

/// @param unknown_is_occupied otherwise it is free
FloorPlan floorPlanOf(const OccupancyGrid&, bool unknown_is_occupied);

/// The rectangle, along the map's axes, of all that the map is about, free cells too; an empty map is a point.
Bounds2D boundsOf(const FloorPlan&, const mrpt::math::TPose2D& world_from_map);

/// By how much [m] solids made of cells and boxes reach over their edges, so that no ray slips between two that touch,
/// however its sums are rounded: about a nanometre.
double seamOf(const FloorPlan&, const mrpt::math::TPose2D& world_from_map);

/// Appends what stands there as solids: a box for every rectangle of cells and for every box.
void addSolids(const FloorPlan&, const mrpt::math::TPose2D& world_from_map, const HeightSpan& heights,
               std::vector<Solid>& solids);

}  // namespace robosim
