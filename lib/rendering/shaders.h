#pragma once
#include <mrpt/opengl/COpenGLViewport.h>
#include <mrpt/opengl/DefaultShaders.h>

namespace robosim {

/// @file
/// Our programs for the graphics processor. They take the place of MRPT's, which compute in `mediump`: that is 16 bits
/// on a processor without GPU, and puts walls below the ground.

/// Shader ids of our own, beyond MRPT's. Within a frame they are drawn in this order.
constexpr mrpt::opengl::shader_id_t kGroundShader = 10;  ///< the ground
constexpr mrpt::opengl::shader_id_t kShadowShader = 11;  ///< the ground once more, in shadow; before what stands on it
constexpr mrpt::opengl::shader_id_t kSolidShader = 12;   ///< meshes, lit
constexpr mrpt::opengl::shader_id_t kSkyShader = 13;     ///< where nothing else is

/// Vertex attributes by location, in all of our programs.
enum Attribute : unsigned { kPosition = 0, kNormal = 1, kColor = 2, kPlace = 3, kPaint = 4 };

/// Makes the programs for a viewport in the calling thread's OpenGL context. Call it once for each viewport and thread
/// that draws our scene. MRPT does not load its own if it finds some; who needs MRPT's as well (text, lines) calls
/// loadDefaultShaders() before.
/// @throws std::runtime_error when the driver does not take them.
void installShaders(mrpt::opengl::COpenGLViewport& viewport);

/// What a program needs to know of the camera.
struct ViewUniforms {
  static void declare(mrpt::opengl::Program&);
  /// Sets the matrices, and the eye's place, for a program in use.
  static void set(const mrpt::opengl::Program&, const mrpt::opengl::TRenderMatrices&);
};

}  // namespace robosim
