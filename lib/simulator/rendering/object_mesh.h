#pragma once
#include "rendering/mesh.h"
#include "world/world.h"

namespace robosim {

/// Height at which what is painted on the floor is shown, so that the floor does not hide it.
constexpr double kPaint_m = 0.002;

/// Adds a static body, in its colour, to a mesh in the world frame. Hot bodies get a metallic material.
/// @param sides of a cylinder, at least 3; with 72, the mesh deviates from the true radius by at most 0.1 %
void addBody(Mesh& mesh, const Body& body, int sides);

/// The occupied cells and walls of a map as bodies, world frame.
std::vector<Body> bodiesOf(const WorldMap& map);

}  // namespace robosim
