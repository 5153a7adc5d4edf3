#pragma once
#include "rendering/mesh.h"
#include "world/world.h"

namespace robosim {

/// Adds a body that stands still, in its colour, to a mesh in the world frame. What is hot shines like metal, as gold
/// does.
/// @param sides of a cylinder, at least 3. With 72 none is further inside the true circle than 0.1 % of its radius.
void addBody(Mesh& mesh, const Body& body, int sides);

/// What a map's occupied cells and walls are made of, in the world frame.
std::vector<Body> bodiesOf(const WorldMap& map);

}  // namespace robosim
