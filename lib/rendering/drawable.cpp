#include "rendering/drawable.h"

#include <stdexcept>

namespace robosim {

const mrpt::rtti::TRuntimeClassId* Drawable::GetRuntimeClass() const { return CRenderizable::GetRuntimeClass(); }

mrpt::rtti::CObject* Drawable::clone() const { throw std::logic_error("a Drawable has no copies"); }

/// So large that MRPT never leaves it out.
mrpt::math::TBoundingBoxf Drawable::internalBoundingBoxLocal() const {
  constexpr float kFar_m = 1e5f;
  return {{-kFar_m, -kFar_m, -kFar_m}, {kFar_m, kFar_m, kFar_m}};
}

std::uint8_t Drawable::serializeGetVersion() const { return 0; }
void Drawable::serializeTo(mrpt::serialization::CArchive&) const {
  throw std::logic_error("a Drawable is not for files");
}
void Drawable::serializeFrom(mrpt::serialization::CArchive&, std::uint8_t) {
  throw std::logic_error("a Drawable is not for files");
}

}  // namespace robosim
