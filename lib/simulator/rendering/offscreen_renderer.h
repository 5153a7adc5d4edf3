#pragma once
#include <memory>
#include <span>

#include <mrpt/math/TPose2D.h>
#include <mrpt/math/TPose3D.h>
#include <opencv2/core/mat.hpp>

#include "rendering/depth_buffer.h"
#include "robots/fleet.h"
#include "sensors/image_source.h"
#include "world/world.h"

namespace robosim {

/// Renders a world without a display, from robot cameras or from any pose. May be called from any thread; drawing takes
/// place in the process's RenderThread.
class OffscreenRenderer : public ImageSource {
 public:
  /// @throws ConfigError when this machine has no OpenGL.
  OffscreenRenderer(const World& world, const Fleet& fleet);
  ~OffscreenRenderer() override;

  void take(const CameraView& camera, const SeenWorld& seen, std::span<const std::uint32_t> robots,
            std::span<std::string> jpegs) override;
  std::vector<Blob> findBlobs(const std::string& jpeg, const std::vector<TargetColor>& colors,
                              unsigned pixels_min) override;

  /// @name Rendering from any pose
  /// @param camera its size and field of view; x of `world_from_camera` is along the optical axis, z up
  ///@{
  /// Blue, green, red, 8 bits each.
  /// @param depth receives the depths of the same picture, if not null
  cv::Mat picture(const CameraInfo& camera, const mrpt::math::TPose3D& world_from_camera, const SeenWorld& seen,
                  DepthBuffer* depth = nullptr);
  /// Depth of each pixel along the optical axis [m], single precision; 0 for the sky.
  cv::Mat depth(const CameraInfo& camera, const mrpt::math::TPose3D& world_from_camera, const SeenWorld& seen);
  ///@}

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// For setImageSourceMaker() (run/local_run.h). @throws ConfigError when this machine has no OpenGL.
std::unique_ptr<ImageSource> makeOffscreenRenderer(const World& world, const Fleet& fleet);

}  // namespace robosim
