#include "rendering/picture_target.h"

#include <GL/gl.h>

namespace robosim {

std::vector<float> PictureTarget::lastDepths() {
  std::vector<float> depths(std::size_t{m_params.width} * m_params.height);
  const auto before = m_fb.bind();
  glReadPixels(0, 0, static_cast<int>(m_params.width), static_cast<int>(m_params.height), GL_DEPTH_COMPONENT, GL_FLOAT,
               depths.data());
  decltype(m_fb)::Bind(before);
  return depths;
}

}  // namespace robosim
