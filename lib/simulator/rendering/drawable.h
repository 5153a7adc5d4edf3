#pragma once
#include <mrpt/opengl/CRenderizable.h>

namespace robosim {

/// Base class of objects in an MRPT scene that RoboSim draws with its own OpenGL calls. Coordinates are in the scene's
/// frame, which is `world`. Each object culls itself, and cannot be serialized.
///
/// OpenGL resources are created on the first draw, and belong to the context and thread of that draw.
class Drawable : public mrpt::opengl::CRenderizable {
 public:
  void renderUpdateBuffers() const override {}
  const mrpt::rtti::TRuntimeClassId* GetRuntimeClass() const override;
  mrpt::rtti::CObject* clone() const override;

 protected:
  mrpt::math::TBoundingBoxf internalBoundingBoxLocal() const override;
  std::uint8_t serializeGetVersion() const override;
  void serializeTo(mrpt::serialization::CArchive&) const override;
  void serializeFrom(mrpt::serialization::CArchive&, std::uint8_t) override;
};

}  // namespace robosim
