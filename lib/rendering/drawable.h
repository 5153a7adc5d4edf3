#pragma once
#include <mrpt/opengl/CRenderizable.h>

namespace robosim {

/// Something in an MRPT scene that we draw with OpenGL ourselves. It stands in the scene's own frame, which is `world`,
/// decides itself what of it is in view, and cannot be written to a file.
///
/// Its OpenGL objects are made when it is first drawn, and belong to the context, and the thread, that drew it.
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
