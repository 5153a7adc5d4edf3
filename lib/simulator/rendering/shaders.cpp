#include "rendering/shaders.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include <GL/gl.h>
#include <GL/glext.h>
#include <mrpt/opengl/Shader.h>

namespace robosim {
namespace {

using mrpt::opengl::Program;

/// Lighting, common to all programs. The sun is behind the left shoulder of a viewer who faces along the y axis of a
/// plan, so that faces along x and y differ in brightness.
constexpr const char* kCommon = R"(#version 300 es
precision highp float;
precision highp int;
const vec3 kSun = vec3(-0.385, -0.550, 0.741);
const vec3 kSunLight = vec3(0.52, 0.50, 0.46);
const vec3 kSkyLight = vec3(0.60, 0.62, 0.66);
const vec3 kGroundLight = vec3(0.52, 0.51, 0.49);
const vec3 kHorizon = vec3(0.82, 0.88, 0.94);
const vec3 kZenith = vec3(0.33, 0.53, 0.80);
const vec3 kHaze = vec3(0.66, 0.70, 0.72);

vec3 skyAt(float up) { return mix(kHorizon, kZenith, sqrt(clamp(up, 0.0, 1.0))); }

// Distance fog.
vec3 hazy(vec3 color, float away) { return mix(color, kHaze, 0.55 * (1.0 - exp(-away / 90.0))); }
)";

constexpr const char* kSolidVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;  // and gloss
layout(location = 2) in vec4 color;   // and whether painted
layout(location = 3) in vec4 place;   // x, y, cosine and sine of the heading
layout(location = 4) in vec4 paint;
uniform mat4 p_matrix, v_matrix;
out vec3 at, facing, tint;
out float gloss;
void main() {
  mat2 turn = mat2(place.z, place.w, -place.w, place.z);
  at = vec3(place.xy + turn * position.xy, position.z);
  facing = vec3(turn * normal.xy, normal.z);
  tint = color.rgb * mix(vec3(1.0), paint.rgb, color.a);
  gloss = normal.w;
  gl_Position = p_matrix * (v_matrix * vec4(at, 1.0));
}
)";

constexpr const char* kSolidFragment = R"(
in vec3 at, facing, tint;
in float gloss;
uniform vec3 eye;
out vec4 seen;
void main() {
  vec3 n = normalize(facing);
  vec3 away = eye - at;
  float distance = length(away);
  vec3 mirrored = reflect(-away / distance, n);
  // Darkens the foot of an object, as ambient occlusion does.
  float foot = mix(0.80, 1.0, smoothstep(0.0, 0.20, at.z));
  vec3 light = mix(kGroundLight, kSkyLight, 0.5 + 0.5 * n.z) + kSunLight * max(dot(n, kSun), 0.0);
  vec3 matt = tint * light * foot;
  float spark = max(dot(mirrored, kSun), 0.0);
  spark *= spark; spark *= spark; spark *= spark; spark *= spark;
  vec3 around = mirrored.z > 0.0 ? skyAt(mirrored.z) : mix(kHorizon, vec3(0.42, 0.40, 0.37), min(1.0, -4.0 * mirrored.z));
  // Environment reflection of bright and dark sides, as in a room.
  float sides = mirrored.x * mirrored.x - mirrored.y * mirrored.y;
  around *= 0.72 + 0.75 * sides * sides;
  vec3 metal = tint * (0.42 * light * foot + 0.95 * around);
  vec3 shiny = mix(matt, metal, 0.85 * gloss) + gloss * spark * mix(vec3(1.0), tint, 0.35) * 0.75;
  seen = vec4(hazy(shiny, distance), 1.0);
}
)";

constexpr const char* kGroundVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 3) in vec4 place;
uniform mat4 p_matrix, v_matrix;
out vec2 at;
void main() {
  at = position.xy + place.xy;
  gl_Position = p_matrix * (v_matrix * vec4(at, position.z, 1.0));
}
)";

// Floor of 1 m tiles inside the bounds, plain ground outside. Lines are antialiased, and fade where they are narrower
// than a pixel.
constexpr const char* kGroundFragment = R"(
in vec2 at;
uniform vec3 eye;
uniform vec4 bounds;  // x and y at least, x and y at most
uniform float light;
out vec4 seen;
void main() {
  vec2 pixel = max(fwidth(at), vec2(1e-5));
  float blur = max(pixel.x, pixel.y);
  vec2 to_line = abs(fract(at - 0.5) - 0.5);
  vec2 line = clamp(0.5 + (0.012 - to_line) / pixel, 0.0, 1.0);
  float lines = mix(max(line.x, line.y), 0.045, clamp(2.5 * blur - 0.2, 0.0, 1.0));
  vec2 tile = clamp((abs(fract(0.5 * at) - 0.5) - 0.25) * 2.0 / pixel, -0.5, 0.5);
  float checker = 4.0 * tile.x * tile.y * clamp(1.6 - 2.0 * blur, 0.0, 1.0);
  vec3 floor_color = vec3(0.80, 0.79, 0.765) * (1.0 + 0.028 * checker) * (1.0 - 0.17 * lines);
  vec2 inside = min(at - bounds.xy, bounds.zw - at);
  vec2 within = clamp(0.5 + inside / pixel, 0.0, 1.0);
  vec2 rim = clamp(0.5 + (inside + 0.08) / pixel, 0.0, 1.0);
  vec3 outside = mix(vec3(0.60, 0.63, 0.55), vec3(0.46, 0.48, 0.47), rim.x * rim.y);
  vec3 color = mix(outside, floor_color, within.x * within.y);
  seen = vec4(hazy(color * light, distance(eye, vec3(at, 0.0))), 1.0);
}
)";

// One triangle that covers the viewport.
constexpr const char* kSkyVertex = R"(
uniform mat4 world_from_picture;
out vec3 ahead;
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  vec4 near = world_from_picture * vec4(corner, -1.0, 1.0);
  vec4 far = world_from_picture * vec4(corner, 0.9, 1.0);
  ahead = far.xyz / far.w - near.xyz / near.w;
  gl_Position = vec4(corner, 1.0, 1.0);
}
)";

constexpr const char* kSkyFragment = R"(
in vec3 ahead;
out vec4 seen;
void main() {
  float up = normalize(ahead).z;
  seen = vec4(up > 0.0 ? skyAt(up) : kHaze, 1.0);
}
)";

Program::Ptr made(const char* vertex, const char* fragment) {
  std::vector<mrpt::opengl::Shader> shaders(2);
  std::string errors;
  auto program = std::make_shared<Program>();
  if (!shaders[0].compile(GL_VERTEX_SHADER, {std::string(kCommon) + vertex}, errors) ||
      !shaders[1].compile(GL_FRAGMENT_SHADER, {std::string(kCommon) + fragment}, errors) ||
      !program->linkProgram(shaders, errors)) {
    throw std::runtime_error("this machine's OpenGL driver rejects the shaders: " + errors);
  }
  return program;
}

}  // namespace

void installShaders(mrpt::opengl::COpenGLViewport& viewport) {
  auto& programs = viewport.shaders();
  programs[kSolidShader] = made(kSolidVertex, kSolidFragment);
  ViewUniforms::declare(*programs[kSolidShader]);
  programs[kGroundShader] = made(kGroundVertex, kGroundFragment);
  ViewUniforms::declare(*programs[kGroundShader]);
  programs[kGroundShader]->declareUniform("bounds");
  programs[kGroundShader]->declareUniform("light");
  programs[kShadowShader] = programs[kGroundShader];
  programs[kSkyShader] = made(kSkyVertex, kSkyFragment);
  programs[kSkyShader]->declareUniform("world_from_picture");
}

void ViewUniforms::declare(Program& program) {
  for (const char* name : {"p_matrix", "v_matrix", "eye"}) program.declareUniform(name);
}

void ViewUniforms::set(const Program& program, const mrpt::opengl::TRenderMatrices& matrices) {
  glUniformMatrix4fv(program.uniformId("p_matrix"), 1, GL_TRUE, matrices.p_matrix.data());
  glUniformMatrix4fv(program.uniformId("v_matrix"), 1, GL_TRUE, matrices.v_matrix.data());
  const auto& v = matrices.v_matrix;
  float eye[3];
  for (int i = 0; i < 3; ++i) eye[i] = -(v(0, i) * v(0, 3) + v(1, i) * v(1, 3) + v(2, i) * v(2, 3));
  glUniform3fv(program.uniformId("eye"), 1, eye);
}

}  // namespace robosim
