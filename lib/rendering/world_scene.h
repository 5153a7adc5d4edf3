#pragma once
#include <memory>
#include <span>

#include <mrpt/math/TPose2D.h>
#include <mrpt/opengl/opengl_frwds.h>

#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// A world and its robots as things of an MRPT OpenGL scene: ground, sky, objects in the file's colours, robots. Built
/// once; before each frame the robots are put where they are, which takes some nanoseconds each. Robots that look the
/// same are drawn by one call, those that look small roughly, and nothing that is out of view.
///
/// It may be drawn in one OpenGL context, and one thread, only: build another one for another. Whoever draws it calls
/// installShaders() (shaders.h) for its viewport.
class WorldScene {
 public:
  /// @param fleet need not outlive this, nor need the world
  WorldScene(const World& world, const Fleet& fleet);
  ~WorldScene();
  WorldScene(const WorldScene&) = delete;
  WorldScene& operator=(const WorldScene&) = delete;

  /// Adds all of it to a scene's main viewport.
  void addTo(mrpt::opengl::COpenGLScene& scene) const;

  /// Puts each robot where it is, in the fleet's order.
  void place(std::span<const mrpt::math::TPose2D> world_from_robot);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
