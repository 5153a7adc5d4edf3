#pragma once

// MRPT 2.14 (Debian 13) renamed the OpenGL resource classes of 2.5 (Debian 12) and left their interfaces unchanged.
#if __has_include(<mrpt/opengl/Buffer.h>)
#include <mrpt/opengl/Buffer.h>
#include <mrpt/opengl/VertexArrayObject.h>
#else
#include <mrpt/opengl/COpenGLBuffer.h>
#include <mrpt/opengl/COpenGLVertexArrayObject.h>
#endif

namespace robosim {

#if __has_include(<mrpt/opengl/Buffer.h>)
using GlBuffer = mrpt::opengl::Buffer;
using GlVertexArray = mrpt::opengl::VertexArrayObject;
#else
using GlBuffer = mrpt::opengl::COpenGLBuffer;
using GlVertexArray = mrpt::opengl::COpenGLVertexArrayObject;
#endif

}  // namespace robosim
