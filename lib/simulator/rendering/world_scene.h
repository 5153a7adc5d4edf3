#pragma once
#include <memory>
#include <span>
#include <vector>

#include <mrpt/math/TPose2D.h>
#include <mrpt/opengl/COpenGLScene.h>

#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// A world and its robots as objects of an MRPT OpenGL scene: ground, sky, objects in the file's colours, robots. The
/// scene is built once; before each frame only the robots' poses are updated, at a few nanoseconds each. Robots of
/// equal appearance are drawn by one call, with levels of detail, and objects out of view are culled.
///
/// An instance may be drawn in one OpenGL context, and one thread, only. The caller must call installShaders()
/// (shaders.h) for its viewport.
class WorldScene {
 public:
  /// @param world, fleet are not referenced after construction
  WorldScene(const World& world, const Fleet& fleet);
  ~WorldScene();
  WorldScene(const WorldScene&) = delete;
  WorldScene& operator=(const WorldScene&) = delete;

  /// Adds all that is drawn to a scene's main viewport.
  void addTo(mrpt::opengl::COpenGLScene& scene) const;
  /// Replaces the objects of the world. @param scene that of addTo()
  void setObjects(const std::vector<WorldObject>& objects, mrpt::opengl::COpenGLScene& scene);

  /// Sets the pose of each robot, in the fleet's order. A robot at kNotShown (sensors/image_source.h) is not drawn.
  void place(std::span<const mrpt::math::TPose2D> world_from_robot);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
