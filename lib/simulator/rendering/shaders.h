#pragma once
#include <mrpt/opengl/COpenGLViewport.h>
#include <mrpt/opengl/DefaultShaders.h>

namespace robosim {

/// @file
/// OpenGL shader programs. They replace those of MRPT, which compute in `mediump`: on a software renderer that is 16
/// bits, and puts walls below the ground.

/// Shader ids, disjoint from MRPT's. Within a frame, objects are drawn in this order.
constexpr mrpt::opengl::shader_id_t kGroundShader = 10;  ///< the ground
constexpr mrpt::opengl::shader_id_t kShadowShader = 11;  ///< shadows on the ground; before the objects that stand on it
constexpr mrpt::opengl::shader_id_t kSolidShader = 12;   ///< meshes, lit
constexpr mrpt::opengl::shader_id_t kSkyShader = 13;     ///< background

/// Vertex attribute locations, equal in all programs.
enum Attribute : unsigned { kPosition = 0, kNormal = 1, kColor = 2, kPlace = 3, kPaint = 4 };

/// Creates the programs for a viewport in the calling thread's OpenGL context. Must be called once for each viewport
/// and thread that draws the scene. MRPT loads its own programs only if none exist; a caller that needs them as well
/// (text, lines) calls loadDefaultShaders() first.
/// @throws std::runtime_error when the driver rejects a program.
void installShaders(mrpt::opengl::COpenGLViewport& viewport);

/// Camera uniforms of a program.
struct ViewUniforms {
  static void declare(mrpt::opengl::Program&);
  /// Sets the matrices and the eye's position for the current program.
  static void set(const mrpt::opengl::Program&, const mrpt::opengl::TRenderMatrices&);
};

}  // namespace robosim
