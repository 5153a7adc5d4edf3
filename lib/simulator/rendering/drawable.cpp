#include "rendering/drawable.h"

#include <stdexcept>

namespace robosim {

const mrpt::rtti::TRuntimeClassId* Drawable::GetRuntimeClass() const { return CRenderizable::GetRuntimeClass(); }

mrpt::rtti::CObject* Drawable::clone() const { throw std::logic_error("a Drawable cannot be copied"); }

/// Large enough that MRPT never culls it.
mrpt::math::TBoundingBoxf Drawable::internalBoundingBoxLocal() const {
  constexpr float kFar_m = 1e5f;
  return {{-kFar_m, -kFar_m, -kFar_m}, {kFar_m, kFar_m, kFar_m}};
}

std::uint8_t Drawable::serializeGetVersion() const { return 0; }
void Drawable::serializeTo(mrpt::serialization::CArchive&) const {
  throw std::logic_error("a Drawable cannot be serialized");
}
void Drawable::serializeFrom(mrpt::serialization::CArchive&, std::uint8_t) {
  throw std::logic_error("a Drawable cannot be serialized");
}

}  // namespace robosim
