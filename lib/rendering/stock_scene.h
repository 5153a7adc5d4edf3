#pragma once
#include <string>

#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// The bytes of a .3Dscene file, which MRPT's SceneViewer3D opens: the world as MRPT's own classes of OpenGL objects,
/// in metres and the world's frame. Each object, map and robot is a mrpt::opengl::CSetOfTriangles of its name; robots
/// stand where they start, and have their pose, so that a program that reads the scene may move them.
std::string toStockScene(const World&, const Fleet&);

}  // namespace robosim
