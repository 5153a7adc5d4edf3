#include "world/scatter_reader.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/printable_text.h"

namespace robosim {

void ScatterReader::read(XmlReader& reader) {
  using Place = PlacementReader::Place;
  Scatter scatter;
  scatter.line = reader.line();
  const double count = reader.number("count", {1, kScatteredMax});
  if (count != std::floor(count)) reader.errorAt("count", "must be a whole number");
  scatter.count = std::max(1, static_cast<int>(count));
  using enum ScatterPattern;
  scatter.pattern = reader.choice<ScatterPattern>(
      "pattern", {{"uniform", uniform}, {"free", free}, {"grid", grid}, {"ring", ring}}, uniform);
  if (scatter.pattern == ring) {
    scatter.ring_center = {reader.length("x", Bounds::any(), world_.unit_m, 0),
                           reader.length("y", Bounds::any(), world_.unit_m, 0)};
    scatter.ring_radius_m = reader.length("radius", Bounds::positive(), world_.unit_m);
  } else {
    readArea(reader, scatter);
  }
  scatter.gap_m = reader.length("gap", Bounds::notNegative(), world_.unit_m, 0);
  if (reader.has("direction")) scatter.direction_rad = reader.number("direction", Bounds::any());
  auto primitive = reader.child("primitive");
  auto robot = reader.child("robot");
  if (!primitive && !robot) reader.error("contains neither a <primitive> nor a <robot> to scatter; add one");
  if (primitive && robot) robot->error("is given beside a <primitive>; put each in its own <scatter>");
  if (primitive) scatter.copied = placements_.readPrimitive(*primitive, Place::scattered);
  if (robot) {
    scatter.copied = placements_.readRobot(*robot, Place::scattered);
    scatter.has_neighbour_ring = reader.choice<bool>("neighbours", {{"none", false}, {"ring", true}}, false);
    if (scatter.has_neighbour_ring && robot->has("neighbour")) {
      robot->errorAt("neighbour", "is given beside neighbours=\"ring\" of the <scatter>; keep one");
    }
  }
  reader.finish();
  readers_.push_back(reader);
  world_.scatters.push_back(std::move(scatter));
}

void ScatterReader::readArea(XmlReader& reader, Scatter& scatter) {
  if (!reader.has("xmin") && !reader.has("xmax") && !reader.has("ymin") && !reader.has("ymax")) return;
  const Bounds2D& all = world_.bounds;
  const auto side = [&](const char* name, double otherwise_m) {
    return reader.length(name, Bounds::any(), world_.unit_m, otherwise_m);
  };
  scatter.area = {side("xmin", all.x_min), side("xmax", all.x_max), side("ymin", all.y_min), side("ymax", all.y_max)};
  if (scatter.area->x_min >= scatter.area->x_max || scatter.area->y_min >= scatter.area->y_max) {
    reader.error("has an area without extent; xmin must be below xmax, and ymin below ymax");
  }
}

void ScatterReader::checkNames() {
  std::size_t total = 0;
  for (std::size_t i = 0; i < world_.scatters.size(); ++i) {
    const Scatter& scatter = world_.scatters[i];
    XmlReader& reader = readers_[i];
    total += static_cast<std::size_t>(scatter.count);
    if (total > kScatteredMax) {
      reader.errorAt("count", "makes more than " + std::to_string(kScatteredMax) +
                                  " scattered robots and objects; use smaller counts");
      return;
    }
    for (int k = 1; k <= scatter.count; ++k) {
      const std::string name = scatter.nameOf(k);
      const auto taken_at = placements_.takeName(name, reader.line());
      if (!taken_at) continue;
      reader.error("'" + quotable(name) + "' is taken already, " + *taken_at + "; scatter with another <name>");
      break;
    }
  }
}

}  // namespace robosim
