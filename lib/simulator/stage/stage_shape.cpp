#include "stage/stage_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/portable_math.h"
#include "world/map_reader.h"

namespace robosim::stage {
namespace {

using mrpt::math::TPoint2D;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPointsMax = 10'000;
constexpr double kBoundary_m = 0.01;

/// The points of a polygon as they are written, without a unit.
std::vector<TPoint2D> readOutline(const PropertyReader& reader, const std::string& count_name,
                                  const std::string& point_name, Notes& notes) {
  std::vector<TPoint2D> outline;
  const Property* count = reader.find(count_name);
  if (!count) return outline;
  const double points = reader.number(count_name, 0);
  if (!(points >= 0 && points <= kPointsMax)) PropertyReader::fail(*count, "must be from 0 to 10,000");
  for (std::size_t i = 0; static_cast<double>(i) < points; ++i) {
    const auto point = reader.numbers(indexed(point_name, i), 2);
    if (point.empty()) PropertyReader::fail(*count, "is more than there are points: add " + indexed(point_name, i));
    outline.emplace_back(point[0], point[1]);
  }
  if (outline.size() < 3) {
    notes.add(count->place, "a block with less than three points is left out");
    outline.clear();
  }
  return outline;
}

std::vector<Prism> readBlocks(const PropertyReader& reader, Notes& notes) {
  std::vector<Prism> prisms;
  const auto add = [&](const PropertyReader& from, const std::string& count, const std::string& point,
                       const std::string& z) {
    Prism prism{readOutline(from, count, point, notes), {0, 1}};
    if (const auto heights = from.numbers(z, 2); !heights.empty()) {
      prism.heights = {std::min(heights[0], heights[1]), std::max(heights[0], heights[1])};
    }
    if (!prism.outline.empty()) prisms.push_back(std::move(prism));
  };
  for (const auto& child : reader.entity().children) {
    if (child.kind == "block") add(PropertyReader(child, reader.units()), "points", "point", "z");
  }
  for (const char* old : {"polygon", "block"}) {
    const double count = reader.number(std::string(old) + "s", 0);
    for (std::size_t i = 0; static_cast<double>(i) < std::min(count, kPointsMax); ++i) {
      const std::string name = indexed(old, i);
      add(reader, name + ".points", name + ".point", name + ".z");
    }
  }
  return prisms;
}

/// Scales blocks so that they fill the size.
void fit(std::vector<Prism>& prisms, const Size& size) {
  double x_min = kInfinity, x_max = -kInfinity, y_min = kInfinity, y_max = -kInfinity, z_min = 0, z_max = 0;
  for (const auto& prism : prisms) {
    for (const auto& point : prism.outline) {
      x_min = std::min(x_min, point.x);
      x_max = std::max(x_max, point.x);
      y_min = std::min(y_min, point.y);
      y_max = std::max(y_max, point.y);
    }
    z_min = std::min(z_min, prism.heights.z_min_m);
    z_max = std::max(z_max, prism.heights.z_max_m);
  }
  const auto scale = [](double extent, double to) { return extent > 0 ? to / extent : 0; };
  const double by_x = scale(x_max - x_min, size.x), by_y = scale(y_max - y_min, size.y);
  const double by_z = scale(z_max - z_min, size.z);
  for (auto& prism : prisms) {
    for (auto& point : prism.outline) {
      point = {(point.x - (x_min + x_max) / 2) * by_x, (point.y - (y_min + y_max) / 2) * by_y};
    }
    prism.heights = {prism.heights.z_min_m * by_z, prism.heights.z_max_m * by_z};
  }
}

Prism box(double x_min, double x_max, double y_min, double y_max, double height_m) {
  return {{{x_min, y_min}, {x_max, y_min}, {x_max, y_max}, {x_min, y_max}}, {0, height_m}};
}

std::optional<Bitmap> readBitmap(const PropertyReader& reader, const Size& size, const FileProvider& files,
                                 Notes& notes) {
  const Property* property = reader.find("bitmap");
  if (!property) return std::nullopt;
  const std::string name = reader.text("bitmap", "");
  Bitmap bitmap;
  try {
    bitmap.file = findStageFile(name, files).name;
    MapReading reading;
    reading.pixel_m = 1;
    reading.is_of_stage = true;
    bitmap.plan = readMap(bitmap.file, files, reading);
  } catch (const ConfigError& error) {
    throw ConfigError(property->place.text() + ": bitmap \"" + name + "\": " + error.what());
  }
  double first_column = kInfinity, end_column = 0, first_row = kInfinity, end_row = 0;
  for (const auto& cells : bitmap.plan.occupied) {
    first_column = std::min<double>(first_column, cells.column);
    first_row = std::min<double>(first_row, cells.row);
    end_column = std::max<double>(end_column, cells.column + cells.columns);
    end_row = std::max<double>(end_row, cells.row + cells.rows);
  }
  if (bitmap.plan.occupied.empty()) {
    notes.add(property->place, "bitmap \"" + name + "\" has no pixel darker than half, and so no body");
    return std::nullopt;
  }
  bitmap.pixel_x_m = size.x / (end_column - first_column);
  bitmap.pixel_y_m = size.y / (end_row - first_row);
  bitmap.body_from_corner = {-size.x / 2 - first_column * bitmap.pixel_x_m, -size.y / 2 - first_row * bitmap.pixel_y_m};
  if (!(bitmap.pixel_x_m > 0 && bitmap.pixel_y_m > 0)) PropertyReader::fail(*property, "has a size of 0");
  return bitmap;
}

double signedArea(const std::vector<TPoint2D>& outline) {
  double area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto& a = outline[i];
    const auto& b = outline[(i + 1) % outline.size()];
    area += (a.x * b.y - b.x * a.y) / 2;
  }
  return area;
}

}  // namespace

std::string indexed(const std::string& name, std::size_t index) { return name + "[" + std::to_string(index) + "]"; }

Shape readShape(const PropertyReader& reader, const Size& size, bool is_box_by_default, const FileProvider& files,
                Notes& notes) {
  Shape shape;
  if (reader.flag("noblocks", false)) return shape;
  shape.prisms = readBlocks(reader, notes);
  fit(shape.prisms, size);
  shape.bitmap = readBitmap(reader, size, files, notes);
  const double x = size.x / 2, y = size.y / 2;
  if (shape.prisms.empty() && !reader.has("bitmap") && is_box_by_default) {
    shape.prisms.push_back(box(-x, x, -y, y, size.z));
  }
  if (reader.flag("boundary", false)) {
    const double thick_m = std::min({kBoundary_m, x, y});
    shape.prisms.push_back(box(-x, x, -y, -y + thick_m, size.z));
    shape.prisms.push_back(box(-x, x, y - thick_m, y, size.z));
    shape.prisms.push_back(box(-x, -x + thick_m, -y, y, size.z));
    shape.prisms.push_back(box(x - thick_m, x, -y, y, size.z));
  }
  return shape;
}

std::optional<Rectangle> rectangleOf(const std::vector<TPoint2D>& outline) {
  if (outline.size() != 4) return std::nullopt;
  const TPoint2D first = outline[1] - outline[0], second = outline[2] - outline[1];
  const TPoint2D closing = outline[3] - outline[2];
  const double length_m = portable::hypot(first.x, first.y), width_m = portable::hypot(second.x, second.y);
  constexpr double kTolerance = 1e-9;
  const double square_m2 = length_m * width_m;
  const bool is_right = std::abs(first.x * second.x + first.y * second.y) <= kTolerance * square_m2;
  const double largest_m = std::max(length_m, width_m);
  const bool is_parallel = std::abs(first.x + closing.x) <= kTolerance * largest_m &&
                           std::abs(first.y + closing.y) <= kTolerance * largest_m;
  if (!(square_m2 > 0) || !is_right || !is_parallel) return std::nullopt;
  Rectangle rectangle;
  rectangle.body_from_center.x = (outline[0].x + outline[2].x) / 2;
  rectangle.body_from_center.y = (outline[0].y + outline[2].y) / 2;
  // A rectangle along the axes is not turned, whichever corner is the first.
  if (first.y == 0 || first.x == 0) {
    rectangle.length_m = std::abs(first.x) + std::abs(second.x);
    rectangle.width_m = std::abs(first.y) + std::abs(second.y);
  } else {
    rectangle.body_from_center.phi = portable::atan2(first.y, first.x);
    rectangle.length_m = length_m;
    rectangle.width_m = width_m;
  }
  return rectangle;
}

std::vector<Rectangle> edgesOf(const std::vector<TPoint2D>& outline) {
  std::vector<Rectangle> edges;
  const double inward = signedArea(outline) >= 0 ? 1 : -1;  // left of an edge of a counter-clockwise polygon
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const TPoint2D from = outline[i], along = outline[(i + 1) % outline.size()] - from;
    const double length_m = portable::hypot(along.x, along.y);
    if (!(length_m > 0)) continue;
    const TPoint2D normal{-along.y / length_m * inward, along.x / length_m * inward};
    Rectangle edge;
    edge.body_from_center = {from.x + along.x / 2 + normal.x * kEdge_m / 2,
                             from.y + along.y / 2 + normal.y * kEdge_m / 2, portable::atan2(along.y, along.x)};
    edge.length_m = length_m;
    edge.width_m = kEdge_m;
    edges.push_back(edge);
  }
  return edges;
}

bool contains(const std::vector<TPoint2D>& outline, const TPoint2D& point) {
  bool is_inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto& a = outline[i];
    const auto& b = outline[(i + 1) % outline.size()];
    if ((a.y > point.y) == (b.y > point.y)) continue;
    if (point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)) is_inside = !is_inside;
  }
  return is_inside;
}

}  // namespace robosim::stage
