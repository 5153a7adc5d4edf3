#include "world/body_xml.h"

#include <charconv>
#include <cmath>

#include "base/angle_units.h"

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

double readProperty(XmlReader& reader, const BodyProperty& property, double default_value) {
  const double value = reader.number(property.name, {0, property.max}, default_value);
  if (!property.is_whole || value == std::floor(value)) return value;
  reader.errorAt(property.name, "is no whole number; write one");
  return default_value;
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
  for (const BodyProperty& property : kBodyProperties) body.*property.value = readProperty(solid, property, 0);
  return body;
}

namespace {

Movable readMovable(XmlReader& settings, const Body& body) {
  Movable movable = Movable::byVolumeOf(body);
  movable.mass_kg = settings.number("mass_kg", Bounds::positive(), movable.mass_kg);
  movable.friction = settings.number("friction", Bounds::notNegative(), movable.friction);
  movable.restitution = settings.number("restitution", {0, 1}, movable.restitution);
  settings.finish();
  return movable;
}

Door readDoor(XmlReader& settings, double unit_m, Body& body) {
  Door door;
  door.world_from_closed = body.world_from_body;
  const bool slides = settings.has("slide");
  if (slides == settings.has("turn_deg")) {
    settings.error("needs either slide or turn_deg, how far it opens");
    return door;
  }
  if (slides) {
    door.slide_m = settings.length("slide", Bounds::any(), unit_m);
    door.speed = settings.length("speed", Bounds::positive(), unit_m, door.speed);
    if (door.slide_m == 0) settings.errorAt("slide", "is 0, so the door never opens; give the length of its way");
  } else {
    // As writeObject() writes them: exactly.
    door.turn_rad = settings.length("turn_deg", {-360, 360}, kRadPerDeg);
    door.speed = settings.length("speed_degps", Bounds::positive(3600), kRadPerDeg, 45 * kRadPerDeg);
    if (door.turn_rad == 0) settings.errorAt("turn_deg", "is 0, so the door never opens; give an angle");
  }
  door.opens_within_m = settings.length("opens_within", Bounds::notNegative(), unit_m, 0);
  door.share = door.open_to = settings.number("open", {0, 1}, 0);
  door.share = settings.number("share", {0, 1}, door.open_to);
  settings.finish();
  if (const auto* cube = std::get_if<Cube>(&body.shape)) {
    body.world_from_body = door.poseAt(door.share, cube->length_m);
  } else {
    settings.error("is given to a <cylinder>; doors are a <cube>");
  }
  return door;
}

std::uint32_t readCount(XmlReader& settings, const char* name, double max) {
  const double value = settings.number(name, {0, max}, 0);
  if (value != std::floor(value)) settings.errorAt(name, "is no whole number; write one");
  return static_cast<std::uint32_t>(value);
}

Walker readWalker(XmlReader& settings, double unit_m, const Body& body) {
  Walker walker;
  const auto point = [&](XmlReader& reader) {
    const double x_m = reader.length("x", Bounds::any(), unit_m);
    return mrpt::math::TPoint2D(x_m, reader.length("y", Bounds::any(), unit_m));
  };
  for (auto& to : settings.all("to")) {
    walker.route.push_back(point(to));
    to.finish();
  }
  walker.home = {body.world_from_body.x, body.world_from_body.y};
  if (auto home = settings.child("home")) {
    walker.home = point(*home);
    home->finish();
  }
  if (walker.route.empty()) {
    walker.wanders_within_m = settings.length("wanders_within", Bounds::positive(), unit_m, 0);
    if (walker.wanders_within_m == 0) settings.error("needs the places of <to> to which it walks, or wanders_within");
  } else if (settings.has("wanders_within")) {
    settings.errorAt("wanders_within", "is given beside the places of <to>; keep one");
  }
  walker.speed_mps = settings.length("speed", Bounds::positive(), unit_m, walker.speed_mps);
  walker.stops_within_m = settings.length("stops_within", Bounds::notNegative(), unit_m, walker.stops_within_m);
  const double places = static_cast<double>(walker.route.size());
  walker.walk.leg = readCount(settings, "leg", walker.route.empty() ? 1e9 : places);
  walker.walk.is_returning = settings.flag("returning", false);
  walker.walk.waited_steps = readCount(settings, "waited_steps", 1e9);
  settings.finish();
  if (!std::holds_alternative<Cylinder>(body.shape)) settings.error("is given to a <cube>; walkers are a <cylinder>");
  return walker;
}

Conveyor readConveyor(XmlReader& settings, double unit_m, const Body& body) {
  const Conveyor conveyor{settings.length("speed", Bounds::any(), unit_m)};
  settings.finish();
  if (!std::holds_alternative<Cube>(body.shape)) {
    settings.error("is given to a <cylinder>; conveyors are a <cube>");
  } else if (body.heights().z_max_m > 0) {
    settings.error("is given to a box whose top is " + toText(body.heights().z_max_m, unit_m) +
                   " above the floor; a belt is let into the floor: let z be minus half of its height");
  }
  return conveyor;
}

}  // namespace

void readMotion(XmlReader& solid, double unit_m, WorldObject& object) {
  auto movable = solid.child("movable");
  auto door = solid.child("door");
  auto walker = solid.child("walker");
  auto conveyor = solid.child("conveyor");
  const bool is_stationary = solid.flag("stationary", !movable);
  const std::string* first = nullptr;
  for (auto* motion : {&movable, &door, &walker, &conveyor}) {
    if (!*motion) continue;
    if (first) (*motion)->error("is given beside <" + *first + ">; keep one");
    if (!first) first = &(*motion)->name();
  }
  if (first && !movable && !is_stationary) {
    solid.errorAt("stationary", "is given beside <" + *first + ">, which says how it moves; remove it");
  }
  if (movable && is_stationary) {
    movable->error("is given to an object that is <stationary>1</stationary>; remove one of the two");
  }
  if (walker) {
    object.walker = readWalker(*walker, unit_m, object.body);
  } else if (conveyor) {
    object.conveyor = readConveyor(*conveyor, unit_m, object.body);
  } else if (door) {
    object.door = readDoor(*door, unit_m, object.body);
  } else if (movable) {
    object.movable = readMovable(*movable, object.body);
  } else if (!is_stationary) {
    object.movable = Movable::byVolumeOf(object.body);
  }
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
  for (const BodyProperty& property : kBodyProperties) {
    if (body.*property.value != 0) element.add(property.name, toText(body.*property.value));
  }
  return element;
}

namespace {

void writeWalker(const Walker& walker, double unit_m, bool has_place, XmlElement& element) {
  const auto add_point = [&](const char* tag, const mrpt::math::TPoint2D& point) {
    element.add(tag, "").attributes = {{"x", toText(point.x, unit_m)}, {"y", toText(point.y, unit_m)}};
  };
  element.attributes = {{"speed", toText(walker.speed_mps, unit_m)},
                        {"stops_within", toText(walker.stops_within_m, unit_m)}};
  if (walker.route.empty()) element.attributes.emplace_back("wanders_within", toText(walker.wanders_within_m, unit_m));
  if (walker.walk.leg > 0) element.attributes.emplace_back("leg", std::to_string(walker.walk.leg));
  if (walker.walk.is_returning) element.attributes.emplace_back("returning", "1");
  if (walker.walk.waited_steps > 0) {
    element.attributes.emplace_back("waited_steps", std::to_string(walker.walk.waited_steps));
  }
  if (has_place) add_point("home", walker.home);
  for (const auto& place : walker.route) add_point("to", place);
}

}  // namespace

void writeObject(const WorldObject& object, double unit_m, bool has_place, XmlElement& owner) {
  Body body = object.body;
  if (object.door) body.world_from_body = object.door->world_from_closed;
  XmlElement& element = writeBody(object.name, body, unit_m, has_place, owner);
  element.add("stationary", object.movable ? "0" : "1");
  if (object.movable) {
    element.add("movable", "").attributes = {{"mass_kg", toText(object.movable->mass_kg)},
                                             {"friction", toText(object.movable->friction)},
                                             {"restitution", toText(object.movable->restitution)}};
  }
  if (object.walker) writeWalker(*object.walker, unit_m, has_place, element.add("walker", ""));
  if (object.conveyor) {
    element.add("conveyor", "").attributes = {{"speed", toText(object.conveyor->speed_mps, unit_m)}};
  }
  if (!object.door) return;
  const Door& door = *object.door;
  auto& settings = element.add("door", "").attributes;
  if (door.turn_rad == 0) {
    settings = {{"slide", toText(door.slide_m, unit_m)}, {"speed", toText(door.speed, unit_m)}};
  } else {
    settings = {{"turn_deg", toText(door.turn_rad, kRadPerDeg)}, {"speed_degps", toText(door.speed, kRadPerDeg)}};
  }
  if (door.opens_within_m > 0) settings.emplace_back("opens_within", toText(door.opens_within_m, unit_m));
  if (door.open_to > 0) settings.emplace_back("open", toText(door.open_to));
  if (door.share != door.open_to) settings.emplace_back("share", toText(door.share));
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
