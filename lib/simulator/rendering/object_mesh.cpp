#include "rendering/object_mesh.h"

#include <cmath>

namespace robosim {

void addBody(Mesh& mesh, const Body& body, int sides) {
  const Material material{.color = body.color, .gloss = body.heat_celsius > 0 ? 0.9f : 0.0f};
  const HeightSpan heights = body.heights();
  Mesh upright;
  if (const auto* cylinder = std::get_if<Cylinder>(&body.shape)) {
    addCone(upright, {{}, heights.z_min_m, heights.z_max_m, cylinder->radius_m, cylinder->radius_m, sides}, material,
            material);
    std::vector<mrpt::math::TPoint3D> bottom;
    for (const auto& p : circlePoints({}, cylinder->radius_m, sides)) {
      bottom.emplace_back(p.x, -p.y, heights.z_min_m);
    }
    if (heights.z_min_m > 0) addPolygon(upright, bottom, material);
  } else {
    const auto& cube = std::get<Cube>(body.shape);
    addBox(upright, {-cube.length_m / 2, -cube.width_m / 2, heights.z_min_m},
           {cube.length_m / 2, cube.width_m / 2, heights.z_max_m}, material);
  }
  mesh.add(upright, {body.world_from_body.x, body.world_from_body.y, 0, body.world_from_body.phi, 0, 0});
}

std::vector<Body> bodiesOf(const WorldMap& map) {
  std::vector<Solid> solids;
  const double height_m = map.isFloor() ? kPaint_m : map.height_m;
  addSolids(map.plan, map.world_from_map, {0, height_m}, solids);
  std::vector<Body> bodies;
  for (const auto& solid : solids) {
    const auto& box = std::get<OrientedBox>(solid.outline);
    bodies.push_back({Cube{2 * box.half_length_m, 2 * box.half_width_m},
                      {box.center.x, box.center.y, std::atan2(box.axis.y, box.axis.x)},
                      height_m / 2,
                      height_m,
                      map.color,
                      0});
  }
  return bodies;
}

}  // namespace robosim
