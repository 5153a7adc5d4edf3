#include "rendering/svg_plan.h"

#include <algorithm>
#include <cmath>

#include <mrpt/core/format.h>

#include "base/utf8.h"
#include "base/xml_element.h"
#include "rendering/plan.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;

constexpr double kLongSide_px = 1200;  ///< initial size in a viewer
constexpr const char* kInk = "#29303a";

/// A length or coordinate [m], rounded to 0.1 mm.
std::string number(double value) { return toText(std::round(value * 1e4) / 1e4 + 0.0); }

std::string colorText(const std::array<float, 3>& color, double brightness = 1) {
  const auto part = [&](float value) { return static_cast<int>(std::lround(value * brightness * 255)); };
  return mrpt::format("#%02x%02x%02x", part(color[0]), part(color[1]), part(color[2]));
}

/// A name without the characters that XML does not allow.
std::string fit(std::string text) {
  const bool is_utf8 = isUtf8(text);
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || (byte >= 0x80 && !is_utf8)) c = '?';
  }
  return text;
}

using Attributes = std::vector<std::pair<std::string, std::string>>;

XmlElement& add(XmlElement& parent, const char* tag, Attributes attributes, std::string text = {}) {
  XmlElement& element = parent.add(tag, std::move(text));
  element.attributes = std::move(attributes);
  return element;
}

std::string placedAt(const TPose2D& pose) {
  std::string text = "translate(" + number(pose.x) + " " + number(-pose.y) + ")";
  if (pose.phi != 0) text += " rotate(" + number(-pose.phi * 180 / M_PI) + ")";
  return text;
}

class SvgPlan {
 public:
  SvgPlan(const World& world, const Fleet& fleet)
      : world_(world),
        fleet_(fleet),
        area_(planArea(world, {})),
        long_m_(std::max({area_.x_max - area_.x_min, area_.y_max - area_.y_min, 1e-3})),
        text_m_(long_m_ / 60) {}

  std::string draw() {
    const double margin_m = 2 * text_m_;
    const double width_m = area_.x_max - area_.x_min + 2 * margin_m;
    const double height_m = area_.y_max - area_.y_min + 4.4 * margin_m;
    const double px_per_m = kLongSide_px / std::max(width_m, height_m);
    svg_.name = "svg";
    svg_.attributes = {{"xmlns", "http://www.w3.org/2000/svg"},
                       {"width", number(width_m * px_per_m)},
                       {"height", number(height_m * px_per_m)},
                       {"viewBox", number(area_.x_min - margin_m) + " " + number(-area_.y_max - 2 * margin_m) + " " +
                                       number(width_m) + " " + number(height_m)},
                       {"font-family", "sans-serif"},
                       {"font-size", number(text_m_)}};
    svg_.add("title", fit(world_.name));
    svg_.add("desc", "Plan of a RoboSim world. One unit is a metre; the place (x, y) is at (x, -y).");
    rectangle({area_.x_min - margin_m, area_.x_min - margin_m + width_m, area_.y_max + 2 * margin_m - height_m,
               area_.y_max + 2 * margin_m},
              "#ebf0f5");
    write(fit(world_.name), area_.x_min, area_.y_max + 0.7 * margin_m, {{"font-size", number(1.3 * text_m_)}});
    drawFloor();
    for (const auto& map : world_.maps) drawMap(map);
    drawObjects();
    for (const auto& robot : fleet_.robots) drawRobot(robot);
    drawScale();
    return toXml(svg_);
  }

 private:
  void rectangle(const Bounds2D& b, const char* color) {
    add(svg_, "rect",
        {{"x", number(b.x_min)},
         {"y", number(-b.y_max)},
         {"width", number(b.x_max - b.x_min)},
         {"height", number(b.y_max - b.y_min)},
         {"fill", color}});
  }

  void write(const std::string& text, double x, double y, Attributes attributes) {
    attributes.insert(attributes.begin(), {{"x", number(x)}, {"y", number(-y)}, {"fill", kInk}});
    add(svg_, "text", std::move(attributes), text);
  }

  void drawFloor() {
    const Bounds2D& b = world_.bounds;
    rectangle(b, "#ffffff");
    const double cell_m = roundLengthUpTo(long_m_ / 15);
    std::string lines;
    for (double x = std::ceil(b.x_min / cell_m) * cell_m; x <= b.x_max; x += cell_m) {
      lines += "M" + number(x) + " " + number(-b.y_max) + "V" + number(-b.y_min);
    }
    for (double y = std::ceil(b.y_min / cell_m) * cell_m; y <= b.y_max; y += cell_m) {
      lines += "M" + number(b.x_min) + " " + number(-y) + "H" + number(b.x_max);
    }
    add(svg_, "path",
        {{"d", lines}, {"stroke", "#dfe4ea"}, {"stroke-width", number(long_m_ / 1200)}, {"fill", "none"}});
  }

  /// All cells as one path, which avoids visible seams between them.
  void drawMap(const WorldMap& map) {
    XmlElement& group = add(svg_, "g", {{"fill", colorText(map.color)}});
    group.add("title", fit(map.file));
    const FloorPlan& plan = map.plan;
    if (!plan.occupied.empty()) {
      std::string cells;
      for (const auto& box : plan.occupied) {
        cells += mrpt::format("M%u %uh%uv%uh-%uz", box.column, box.row, box.columns, box.rows, box.columns);
      }
      const std::string scale = toText(plan.cell_m);
      add(group, "path",
          {{"transform", placedAt(map.world_from_map + plan.map_from_grid) + " scale(" + scale + " -" + scale + ")"},
           {"d", cells}});
    }
    for (const auto& box : plan.boxes) {
      // Walls of a map may be thinner than a visible line.
      XmlElement& wall = drawBox(group, map.world_from_map + box.map_from_box, box.length_m, box.width_m);
      wall.attributes.emplace_back("stroke", colorText(map.color));
      wall.attributes.emplace_back("stroke-width", number(long_m_ / 800));
    }
  }

  static XmlElement& drawBox(XmlElement& parent, const TPose2D& pose, double length_m, double width_m) {
    return add(parent, "rect",
               {{"transform", placedAt(pose)},
                {"x", number(-length_m / 2)},
                {"y", number(-width_m / 2)},
                {"width", number(length_m)},
                {"height", number(width_m)}});
  }

  static XmlElement& drawShape(XmlElement& parent, const Body& body) {
    if (const auto* cube = std::get_if<Cube>(&body.shape)) {
      return drawBox(parent, body.world_from_body, cube->length_m, cube->width_m);
    }
    return add(parent, "circle",
               {{"cx", number(body.world_from_body.x)},
                {"cy", number(-body.world_from_body.y)},
                {"r", number(std::get<Cylinder>(body.shape).radius_m)}});
  }

  void drawObjects() {
    std::vector<const WorldObject*> objects;
    for (const auto& object : world_.objects) objects.push_back(&object);
    std::stable_sort(objects.begin(), objects.end(), [](const WorldObject* a, const WorldObject* b) {
      return a->body.heights().z_max_m < b->body.heights().z_max_m;
    });
    for (const WorldObject* object : objects) {
      XmlElement& group = add(svg_, "g", {});
      group.add("title", fit(object->name));
      if (object->body.heat_celsius > 0) {
        Attributes& glow = drawShape(group, object->body).attributes;
        glow.emplace_back("fill", "none");
        glow.emplace_back("stroke", "#ff8c26");
        glow.emplace_back("stroke-width", number(long_m_ / 40));
        glow.emplace_back("stroke-opacity", "0.25");
      }
      paint(drawShape(group, object->body), object->body);
      if (object->body.heat_celsius > 0) writeName(object->name, object->body);
    }
  }

  void paint(XmlElement& shape, const Body& body) const {
    shape.attributes.emplace_back("fill", colorText(body.color));
    shape.attributes.emplace_back("stroke", colorText(body.color, 0.55));
    shape.attributes.emplace_back("stroke-width", number(long_m_ / 1200));
  }

  void drawRobot(const FleetRobot& robot) {
    XmlElement& group = add(svg_, "g", {});
    group.add("title", fit(robot.info.name + ", " + robot.info.model));
    paint(drawShape(group, robot.body), robot.body);
    add(group, "path",
        {{"transform", placedAt(robot.world_from_start)},
         {"d", "M0 0H" + number(robot.info.radius_m)},
         {"stroke", kInk},
         {"stroke-width", number(robot.info.radius_m / 5)}});
    writeName(robot.info.name, robot.body);
  }

  void writeName(const std::string& name, const Body& body) {
    write(fit(name), body.world_from_body.x, body.world_from_body.y + body.coveringRadius() + 0.4 * text_m_,
          {{"text-anchor", "middle"},
           {"stroke", "#ffffff"},
           {"stroke-width", number(text_m_ / 5)},
           {"paint-order", "stroke"}});
  }

  void drawScale() {
    const double length_m = roundLengthUpTo(long_m_ / 6);
    const double y = area_.y_min - 2 * text_m_;
    const double tick = text_m_ / 3;
    add(svg_, "path",
        {{"d", "M" + number(area_.x_min) + " " + number(-y - tick) + "v" + number(2 * tick) + "m0 " + number(-tick) +
                   "h" + number(length_m) + "m0 " + number(-tick) + "v" + number(2 * tick)},
         {"stroke", kInk},
         {"stroke-width", number(long_m_ / 600)},
         {"fill", "none"}});
    write(toText(length_m) + " m", area_.x_min + length_m + text_m_ / 2, y - text_m_ / 3, {});
  }

  const World& world_;
  const Fleet& fleet_;
  Bounds2D area_;
  double long_m_;
  double text_m_;
  XmlElement svg_;
};

}  // namespace

std::string toSvg(const World& world, const Fleet& fleet) { return SvgPlan(world, fleet).draw(); }

}  // namespace robosim
