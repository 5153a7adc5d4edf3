#pragma once
#include <vector>

#include <mrpt/opengl/CFBORender.h>

namespace robosim {

/// Framebuffer for pictures of one size. Used in the render thread only.
class PictureTarget : public mrpt::opengl::CFBORender {
 public:
  using CFBORender::CFBORender;

  /// Depth buffer of the last picture, row by row from the bottom: 0 at the near plane, 1 at the far plane. MRPT's own
  /// conversion to metres (render_RGBD()) uses a table of 2¹⁷ entries, which has steps of 0.3 m at a depth of 30 m.
  std::vector<float> lastDepths();
};

}  // namespace robosim
