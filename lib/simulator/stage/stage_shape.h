#pragma once
#include <optional>
#include <string>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "geometry/shapes/solid.h"
#include "stage/stage_reader.h"
#include "world/floor_plan.h"

namespace robosim::stage {

/// An upright prism over a polygon, in the frame of the body: its centre in plan, and its underside.
struct Prism {
  std::vector<mrpt::math::TPoint2D> outline;
  HeightSpan heights;
};

/// A body from a picture. Its frame is that of the body; the pixels' first row is the lowest.
struct Bitmap {
  std::string file;  ///< FileProvider name
  FloorPlan plan;    ///< the solid pixels, with cells of 1
  double pixel_x_m = 0, pixel_y_m = 0;
  mrpt::math::TPoint2D body_from_corner;  ///< of the lower left corner of the picture
};

/// Shape of a model.
struct Shape {
  std::vector<Prism> prisms;     ///< blocks, walls of `boundary`, or one box
  std::optional<Bitmap> bitmap;  ///< its height is that of the model
};

/// Reads the shape of an entity from its blocks, polygons, bitmap and boundary, scaled to its size. Blocks and solid
/// pixels together fill the size exactly, whatever their coordinates are and however wide the picture's margin is.
/// @param is_box_by_default whether a model with neither blocks nor a bitmap is a box
/// @throws ConfigError "file:line: what"
Shape readShape(const PropertyReader& reader, const Size& size, bool is_box_by_default, const FileProvider& files,
                Notes& notes);

/// Name of a property with an index, as `point[3]`.
std::string indexed(const std::string& name, std::size_t index);

/// A rectangle in plan, of any orientation.
struct Rectangle {
  mrpt::math::TPose2D body_from_center;
  double length_m = 0, width_m = 0;
};
/// The rectangle that a polygon is, if it is one.
std::optional<Rectangle> rectangleOf(const std::vector<mrpt::math::TPoint2D>& outline);
/// Thickness [m] of the walls that stand for the edges of a polygon.
constexpr double kEdge_m = 1e-4;
/// Walls along the edges of a polygon, with their outer faces on the edges: rays from outside and from inside meet them
/// where they meet the polygon, within kEdge_m.
std::vector<Rectangle> edgesOf(const std::vector<mrpt::math::TPoint2D>& outline);
/// Whether a polygon contains a point.
bool contains(const std::vector<mrpt::math::TPoint2D>& outline, const mrpt::math::TPoint2D& point);

}  // namespace robosim::stage
