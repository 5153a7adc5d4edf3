#pragma once
#include <vector>

#include <mrpt/opengl/CFBORender.h>

namespace robosim {

/// What pictures of one size are drawn into. In the render thread only.
class PictureTarget : public mrpt::opengl::CFBORender {
 public:
  using CFBORender::CFBORender;

  /// The depth buffer of the picture that was drawn last: from 0, the nearest that is drawn, to 1, row by row from the
  /// bottom. MRPT's own way from there to metres (render_RGBD()) goes through a table of 2¹⁷ entries: at 30 m, that is
  /// a step of 0.3 m.
  std::vector<float> lastDepths();
};

}  // namespace robosim
