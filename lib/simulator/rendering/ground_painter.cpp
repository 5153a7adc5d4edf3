#include "rendering/ground_painter.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <mrpt/core/format.h>

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

Bounds2D around(const TPoint2D& center, double half_width, double half_height) {
  return {center.x - half_width, center.x + half_width, center.y - half_height, center.y + half_height};
}

bool cover(const Bounds2D& a, const Bounds2D& b) {
  return a.x_min < b.x_max && b.x_min < a.x_max && a.y_min < b.y_max && b.y_min < a.y_max;
}

bool coversAny(const Bounds2D& place, const std::vector<Bounds2D>& others) {
  return std::any_of(others.begin(), others.end(), [&](const Bounds2D& other) { return cover(place, other); });
}

/// Squares of one pixel that cover a line.
std::vector<Bounds2D> squaresAlong(const TPoint2D& from, const TPoint2D& to) {
  std::vector<Bounds2D> squares;
  const int steps = static_cast<int>((to - from).norm()) + 1;
  for (int k = 0; k <= steps; ++k) squares.push_back(around(from + (to - from) * (1.0 * k / steps), 0.5, 0.5));
  return squares;
}

constexpr double kScaleGap_px = 10;  ///< between a scale bar and its number

double scaleLength(const GroundView& view, double text_px) {
  constexpr double kMaxOfText = 16;
  return roundLengthUpTo(kMaxOfText * text_px / view.pixelsPerMetre());
}

std::string scaleLabel(double length_m) { return mrpt::format("%g m", length_m); }

}  // namespace

std::vector<Color> robotColors(const Fleet& fleet) {
  std::vector<Color> colors;
  for (const auto& robot : fleet.robots) colors.push_back(robot.color);
  return colors;
}

double gridStep(const GroundView& view) {
  constexpr double kGridMax_px = 64;
  return roundLengthUpTo(kGridMax_px / view.pixelsPerMetre());
}

void drawFloor(DrawingSurface& surface, const Bounds2D& b) {
  const GroundView& view = surface.view();
  const mrpt::math::TPose2D center{(b.x_min + b.x_max) / 2, (b.y_min + b.y_max) / 2, 0};
  const Outline floor = OrientedBox::from(center, b.x_max - b.x_min, b.y_max - b.y_min);
  surface.fill(floor, kFloorColor);
  const double cell_m = gridStep(view);
  const Bounds2D visible = view.visibleArea();
  const Bounds2D seen{std::max(b.x_min, visible.x_min), std::min(b.x_max, visible.x_max),
                      std::max(b.y_min, visible.y_min), std::min(b.y_max, visible.y_max)};
  for (double x = std::ceil(seen.x_min / cell_m) * cell_m; x <= seen.x_max; x += cell_m) {
    surface.line(view.toPixel({x, seen.y_min}), view.toPixel({x, seen.y_max}), 1, kGridColor);
  }
  for (double y = std::ceil(seen.y_min / cell_m) * cell_m; y <= seen.y_max; y += cell_m) {
    surface.line(view.toPixel({seen.x_min, y}), view.toPixel({seen.x_max, y}), 1, kGridColor);
  }
  surface.outline(floor, 1, mix(kGridColor, kInkColor, 0.3f));
}

namespace {

void drawMap(DrawingSurface& surface, const WorldMap& map) {
  surface.fillCells(map.plan, map.world_from_map, map.color);
  for (const auto& box : map.plan.boxes) {
    const Outline shape = OrientedBox::from(map.world_from_map + box.map_from_box, box.length_m, box.width_m);
    surface.fill(shape, map.color);
    surface.outline(shape, 1.5, map.color);  // walls of a map may be thinner than a visible line
  }
}

}  // namespace

void drawFloorAreas(DrawingSurface& surface, const World& world, const std::vector<WorldObject>& objects) {
  for (const auto& map : world.maps) {
    if (map.isFloor()) drawMap(surface, map);
  }
  for (const auto& object : objects) {
    if (object.body.isFloor()) surface.fill(object.body.solid().outline, object.body.color);
  }
}

void drawMaps(DrawingSurface& surface, const World& world) {
  for (const auto& map : world.maps) {
    if (!map.isFloor()) drawMap(surface, map);
  }
}

void drawObjects(DrawingSurface& surface, const std::vector<WorldObject>& objects) {
  std::vector<const Body*> bodies;
  for (const auto& object : objects) {
    if (!object.body.isFloor()) bodies.push_back(&object.body);
  }
  std::stable_sort(bodies.begin(), bodies.end(),
                   [](const Body* a, const Body* b) { return a->heights().z_max_m < b->heights().z_max_m; });
  for (const Body* body : bodies) {
    if (body->heat_celsius > 0) surface.glow(body->solid().outline, 26, kGlowColor);
    if (body->light_cd > 0) surface.glow(body->solid().outline, 26, body->color);
  }
  for (const Body* body : bodies) {
    const Outline shape = body->solid().outline;
    surface.fill(shape, body->color);
    surface.outline(shape, 1, mix(body->color, {0, 0, 0}, 0.45f));
  }
}

void drawRobot(DrawingSurface& surface, const TPoint2D& center, double radius_px, const TPoint2D& ahead,
               const Color& color) {
  const bool small = radius_px < 6;  // too small for details
  const auto disc = small ? &DrawingSurface::dot : &DrawingSurface::disc;
  (surface.*disc)(center, radius_px, mix(color, {0, 0, 0}, 0.5f));
  (surface.*disc)(center, radius_px - 1, color);
  surface.line(center, center + ahead * (radius_px + (small ? 4 : -1.5)), 2, small ? color : kWhite);
}

void drawRobotOfMany(DrawingSurface& surface, const TPoint2D& center, double radius_px, const TPoint2D& ahead,
                     const Color& color) {
  if (radius_px >= 6) return drawRobot(surface, center, radius_px, ahead, color);
  const Color dark = mix(color, {0, 0, 0}, 0.2f);  // stands out of the paths
  surface.dot(center, radius_px, dark);
  if (radius_px >= 2.5) surface.line(center, center + ahead * (radius_px + 1.5), 1.2, dark);
}

double drawScale(DrawingSurface& surface, const TPoint2D& from, double text_px) {
  const double length_m = scaleLength(surface.view(), text_px);
  const double length_px = length_m * surface.view().pixelsPerMetre();
  const TPoint2D to(from.x + length_px, from.y);
  surface.line(from, to, 2, kInkColor);
  for (const TPoint2D& end : {from, to}) surface.line({end.x, end.y - 5}, {end.x, end.y + 5}, 2, kInkColor);
  surface.text({to.x + kScaleGap_px, to.y}, scaleLabel(length_m), text_px, kInkColor);
  return length_px;
}

double scaleWidth(const GroundView& view, double text_px,
                  const std::function<double(const std::string& text)>& width_of) {
  const double length_m = scaleLength(view, text_px);
  return length_m * view.pixelsPerMetre() + kScaleGap_px + width_of(scaleLabel(length_m));
}

NameWriter::NameWriter(DrawingSurface& surface, double text_px) : surface_(surface), text_px_(text_px) {
  const TPoint2D half(surface_.view().width() / 2.0, surface_.view().height() / 2.0);
  within_ = around(half, half.x - 2, half.y - 2);
}

NameWriter::NameWriter(DrawingSurface& surface, double text_px, const Bounds2D& within)
    : surface_(surface), text_px_(text_px), within_(within), has_leaders_(true) {}

void NameWriter::keepClear(const TPoint2D& center, double half_width_px, double half_height_px) {
  objects_.push_back(around(center, half_width_px, half_height_px));
}

bool NameWriter::isFree(const Bounds2D& place) const {
  return within_.covers(place) && !coversAny(place, objects_) && !coversAny(place, labels_);
}

void NameWriter::writeAt(const Bounds2D& place, const std::string& name, const Color& color) {
  labels_.push_back(place);
  surface_.text({place.x_min + 2, (place.y_min + place.y_max) / 2}, name, text_px_, color);
}

void NameWriter::write(const std::string& name, const TPoint2D& center, double half_width_px, double half_height_px,
                       const Color& color) {
  const double width = surface_.textWidth(name, text_px_);
  const double height = text_px_ * kLineHeight;
  const double right = half_width_px + 5 + width / 2, up = half_height_px + 4 + height / 2;
  const TPoint2D offsets[] = {{right, 0},        {-right, 0},         {0, -up},          {0, up}, {right * 0.8, -up},
                              {right * 0.8, up}, {-right * 0.8, -up}, {-right * 0.8, up}};
  std::optional<Bounds2D> best;
  double best_contrast = 0;
  for (const auto& offset : offsets) {
    const Bounds2D place = around(center + offset, width / 2 + 2, height / 2);
    if (!isFree(place)) continue;
    const double contrast = surface_.contrast(place);
    if (best && contrast >= best_contrast) continue;
    best = place;
    best_contrast = contrast;
  }
  if (best) return writeAt(*best, name, color);
  if (has_leaders_) writeWithLeader(name, center, {half_width_px, half_height_px}, {width / 2 + 2, height / 2}, color);
}

void NameWriter::writeWithLeader(const std::string& name, const TPoint2D& center, const TPoint2D& half_object,
                                 const TPoint2D& half_label, const Color& color) {
  constexpr int kDirections = 24;
  constexpr double kRing = 1.3, kLongest = 14;  // in heights of a capital
  // First away from the other objects. A leader over another object would be ambiguous.
  TPoint2D middle_of_objects = center;
  for (const auto& object : objects_) {
    const TPoint2D at((object.x_min + object.x_max) / 2, (object.y_min + object.y_max) / 2);
    middle_of_objects += (at - center) * (1.0 / static_cast<double>(objects_.size()));
  }
  const double away_rad = std::atan2(middle_of_objects.y - center.y, center.x - middle_of_objects.x);
  for (double away_px = kRing * text_px_; away_px < kLongest * text_px_; away_px += kRing * text_px_) {
    for (int i = 0; i < kDirections; ++i) {
      const double angle_rad = away_rad + (i % 2 == 0 ? 1 : -1) * M_PI * ((i + 1) / 2) * 2 / kDirections;
      const TPoint2D middle(center.x + std::cos(angle_rad) * (half_object.x + away_px + half_label.x),
                            center.y - std::sin(angle_rad) * (half_object.y + away_px + half_label.y));
      const Bounds2D place = around(middle, half_label.x, half_label.y);
      // From the object's edge to the nearest point of the label.
      const TPoint2D to(std::clamp(center.x, place.x_min, place.x_max), std::clamp(center.y, place.y_min, place.y_max));
      const TPoint2D way = to - center;
      const double leaves = std::min((half_object.x + 1) / std::abs(way.x), (half_object.y + 1) / std::abs(way.y));
      const auto leader = squaresAlong(center + way * leaves, to);
      const auto is_covered = [&](const Bounds2D& square) {
        return coversAny(square, labels_) || coversAny(square, objects_);
      };
      if (!isFree(place) || std::any_of(leader.begin(), leader.end(), is_covered)) continue;
      surface_.line(center + way * leaves, to, 1, color);
      labels_.insert(labels_.end(), leader.begin(), leader.end());
      return writeAt(place, name, color);
    }
  }
}

void NameWriter::writeHotObjects(const std::vector<WorldObject>& objects) {
  struct Label {
    const std::string& name;
    TPoint2D center, half;  // [px]
  };
  std::vector<Label> labels;
  const GroundView& view = surface_.view();
  for (const auto& object : objects) {
    if (object.body.heat_celsius <= 0) continue;
    const Bounds2D b = boundsOf(object.body.solid().outline);
    const auto& pose = object.body.world_from_body;
    labels.push_back({object.name, view.toPixel({pose.x, pose.y}),
                      TPoint2D(b.x_max - b.x_min, b.y_max - b.y_min) * (view.pixelsPerMetre() / 2)});
  }
  for (const auto& label : labels) keepClear(label.center, label.half.x, label.half.y);
  for (const auto& label : labels) {
    write(label.name, label.center, label.half.x, label.half.y, mix(kGlowColor, {0.3f, 0, 0}, 0.6f));
  }
}

}  // namespace robosim
