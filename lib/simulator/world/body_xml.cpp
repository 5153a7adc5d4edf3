#include "world/body_xml.h"

#include <charconv>

namespace robosim {
namespace {

/// The shortest text that, parsed as a double, gives exactly `value`.
std::string floatText(float value) {
  char buffer[32];
  const std::string text{buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
  // Double rounding from decimal to double to float may be wrong for a number very close to the middle between two
  // floats.
  return static_cast<float>(toNumber(text, 1)) == value ? text : toText(static_cast<double>(value));
}

}  // namespace

std::optional<XmlReader> solidIn(XmlReader& owner) {
  auto cylinder = owner.child("cylinder");
  auto cube = owner.child("cube");
  if (cylinder && cube) cube->error("is given beside a <cylinder>; keep one");
  return cylinder ? cylinder : cube;
}

Body readBody(XmlReader& solid, double unit_m, bool has_place) {
  const auto length = [&](const char* tag, Bounds bounds) { return solid.length(tag, bounds, unit_m); };
  Body body;
  if (solid.name() == "cylinder") {
    body.shape = Cylinder{length("radius", Bounds::positive())};
  } else {
    const double length_m = length("length", Bounds::positive());
    body.shape = Cube{length_m, length("width", Bounds::positive())};
  }
  if (has_place) body.world_from_body = readPose(solid, unit_m);
  body.center_z_m = length("z", Bounds::any());
  body.height_m = length("height", Bounds::positive());
  if (const auto color = readColor(solid)) body.color = *color;
  body.heat_celsius = solid.number("hot", Bounds::notNegative(), 0);
  body.reflectivity = solid.number("reflectivity", {0, 1}, kReflectivity);
  return body;
}

std::optional<Movable> readMovable(XmlReader& solid, const Body& body) {
  auto settings = solid.child("movable");
  const bool is_stationary = solid.flag("stationary", !settings);
  if (!settings) return is_stationary ? std::nullopt : std::optional(Movable::byVolumeOf(body));
  if (is_stationary) {
    settings->error("is given to an object that is <stationary>1</stationary>; remove one of the two");
  }
  Movable movable = Movable::byVolumeOf(body);
  movable.mass_kg = settings->number("mass_kg", Bounds::positive(), movable.mass_kg);
  movable.friction = settings->number("friction", Bounds::notNegative(), movable.friction);
  movable.restitution = settings->number("restitution", {0, 1}, movable.restitution);
  settings->finish();
  return movable;
}

mrpt::math::TPose2D readPose(XmlReader& reader, double unit_m) {
  const double x = reader.length("x", Bounds::any(), unit_m);
  const double y = reader.length("y", Bounds::any(), unit_m);
  return {x, y, reader.number("direction", Bounds::any(), 0)};
}

std::optional<std::array<float, 3>> readColor(XmlReader& reader) {
  const auto rgb = reader.numbers("color", 3, {0, 1}, {});
  if (rgb.empty()) return std::nullopt;
  return std::array{static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
}

XmlElement& writeBody(const std::string& name, const Body& body, double unit_m, bool has_place, XmlElement& owner) {
  const auto* cylinder = std::get_if<Cylinder>(&body.shape);
  XmlElement& element = owner.add(cylinder ? "cylinder" : "cube");
  const auto add_length = [&](const char* tag, double length_m) { element.add(tag, toText(length_m, unit_m)); };
  element.add("name", name);
  if (has_place) writePose(body.world_from_body, unit_m, element);
  add_length("z", body.center_z_m);
  if (cylinder) {
    add_length("radius", cylinder->radius_m);
  } else {
    const auto& cube = std::get<Cube>(body.shape);
    add_length("length", cube.length_m);
    add_length("width", cube.width_m);
  }
  add_length("height", body.height_m);
  element.add("color", colorText(body.color));
  element.add("hot", toText(body.heat_celsius));
  if (body.reflectivity != kReflectivity) element.add("reflectivity", toText(body.reflectivity));
  return element;
}

void writeObject(const WorldObject& object, double unit_m, bool has_place, XmlElement& owner) {
  XmlElement& element = writeBody(object.name, object.body, unit_m, has_place, owner);
  element.add("stationary", object.movable ? "0" : "1");
  if (!object.movable) return;
  element.add("movable", "").attributes = {{"mass_kg", toText(object.movable->mass_kg)},
                                           {"friction", toText(object.movable->friction)},
                                           {"restitution", toText(object.movable->restitution)}};
}

void writePose(const mrpt::math::TPose2D& pose, double unit_m, XmlElement& element) {
  element.add("x", toText(pose.x, unit_m));
  element.add("y", toText(pose.y, unit_m));
  element.add("direction", toText(pose.phi));
}

std::string colorText(const std::array<float, 3>& color) {
  return floatText(color[0]) + " " + floatText(color[1]) + " " + floatText(color[2]);
}

}  // namespace robosim
