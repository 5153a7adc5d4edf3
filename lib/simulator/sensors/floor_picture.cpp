#include "sensors/floor_picture.h"

#include <algorithm>

#include "base/portable_pose.h"

namespace robosim {

bool isOn(const Outline& area, const mrpt::math::TPoint2D& point) { return nearestPoint(area, point) == point; }

FloorPicture::FloorPicture(const WorldMap& map)
    : grid_from_world_(portable::relative(portable::compose(map.world_from_map, map.plan.map_from_grid), {})),
      cell_m_(map.plan.cell_m),
      columns_(map.plan.columns),
      rows_(map.plan.rows),
      painted_(std::size_t{columns_} * rows_),
      color_(map.color) {
  for (const CellRectangle& part : map.plan.occupied) {
    for (std::size_t row = part.row; row < part.row + part.rows; ++row) {
      const auto first = painted_.begin() + static_cast<std::ptrdiff_t>(row * columns_ + part.column);
      std::fill(first, first + part.columns, true);
    }
  }
  for (const PlanBox& box : map.plan.boxes) {
    boxes_.emplace_back(
        OrientedBox::from(portable::compose(map.world_from_map, box.map_from_box), box.length_m, box.width_m));
  }
}

bool FloorPicture::isPainted(const mrpt::math::TPoint2D& at) const {
  const auto in_grid = portable::compose(grid_from_world_, at);
  const double column = in_grid.x / cell_m_, row = in_grid.y / cell_m_;
  const bool is_in_grid = column >= 0 && row >= 0 && column < columns_ && row < rows_;
  if (is_in_grid && painted_[static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column)]) return true;
  return std::any_of(boxes_.begin(), boxes_.end(), [&](const Outline& box) { return isOn(box, at); });
}

std::vector<FloorPicture> floorPicturesOf(const std::vector<WorldMap>& maps) {
  std::vector<FloorPicture> pictures;
  for (const WorldMap& map : maps) {
    if (map.isFloor()) pictures.emplace_back(map);
  }
  return pictures;
}

}  // namespace robosim
