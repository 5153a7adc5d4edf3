#pragma once
#include <string>

#include "robots/fleet.h"
#include "robots/view_layers.h"
#include "world/world.h"

namespace robosim {

/// Contents of a .3Dscene file for MRPT's SceneViewer3D: the world as MRPT's own OpenGL classes, in metres and the
/// world frame. Each object, map and robot is a named mrpt::opengl::CSetOfTriangles; robots are at their start poses,
/// stored as object poses, so that a program that reads the scene can move them. Their names are displayed unless there
/// are many (DetailLevel::kManyRobots); many robots have fewer triangles.
/// @param layers of which `names` and `only` apply
std::string toStockScene(const World&, const Fleet&, const ViewLayers& layers = {});

}  // namespace robosim
