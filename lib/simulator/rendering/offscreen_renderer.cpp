#include "rendering/offscreen_renderer.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <mrpt/opengl/COpenGLScene.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "rendering/blob_search.h"
#include "rendering/camera_effects.h"
#include "rendering/picture_target.h"
#include "rendering/render_thread.h"
#include "rendering/shaders.h"
#include "rendering/world_scene.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;
using mrpt::math::TPose3D;
using mrpt::poses::CPose3D;

/// MRPT camera at a pose of RoboSim's camera frame (x forward); MRPT's has z forward and x to the right.
mrpt::opengl::CCamera cameraAt(const CameraInfo& info, const CPose3D& world_from_camera) {
  mrpt::img::TCamera pinhole;
  pinhole.ncols = info.width_px;
  pinhole.nrows = info.height_px;
  const double focal_px = info.focalLength();
  pinhole.setIntrinsicParamsFromValues(focal_px, focal_px, info.width_px / 2.0, info.height_px / 2.0);
  mrpt::opengl::CCamera camera;
  camera.set6DOFMode(true);
  camera.setProjectiveFromPinhole(pinhole);
  camera.setPose(world_from_camera + CPose3D(0, 0, 0, -M_PI / 2, 0, -M_PI / 2));
  return camera;
}

}  // namespace

struct OffscreenRenderer::Impl {
  Impl(const World& the_world, const Fleet& the_fleet) : thread(RenderThread::shared()), objects(the_world.objects) {
    for (const auto& robot : the_fleet.robots) underside_m.push_back(robot.body().heights().z_min_m);
    thread->run([&](RenderThread::Targets&) {
      scene = std::make_unique<mrpt::opengl::COpenGLScene>();
      scene->getViewport()->setViewportClipDistances(kNearPlane_m, kFarPlane_m);
      world.emplace(the_world, the_fleet);
      world->addTo(*scene);
      installShaders(*scene->getViewport());
    });
  }
  ~Impl() {
    thread->run([this](RenderThread::Targets&) {
      scene.reset();
      world.reset();
    });
  }

  /// Shows what there is to see. In the render thread only.
  void show(const SeenWorld& seen) {
    if (!seen.objects.isSameList(shown_objects)) {
      world->setObjects(seen.objects.orThose(objects), *scene);
      shown_objects = seen.objects;
    }
    world->place(seen.world_from_robot);
  }

  std::shared_ptr<RenderThread> thread;
  const std::vector<WorldObject> objects;  ///< of the world
  std::vector<double> underside_m;         ///< of each robot
  // Used in the render thread only:
  std::unique_ptr<mrpt::opengl::COpenGLScene> scene;
  std::optional<WorldScene> world;
  ChangedObjects shown_objects;
};

OffscreenRenderer::OffscreenRenderer(const World& world, const Fleet& fleet)
    : impl_(std::make_unique<Impl>(world, fleet)) {}

OffscreenRenderer::~OffscreenRenderer() = default;

void OffscreenRenderer::take(const CameraView& camera, const SeenWorld& seen, std::span<const std::uint32_t> robots,
                             std::span<std::string> jpegs) {
  const bool has_aims = !camera.aims.empty();
  std::vector<CameraView> aimed;
  if (has_aims) {
    for (std::size_t i = 0; i < robots.size(); ++i) aimed.push_back(camera.aimedFor(i));
  }
  const auto view_of = [&](std::size_t i) -> const CameraView& { return has_aims ? aimed[i] : camera; };
  // A target exists for each size: those of a camera that zooms would be many.
  const std::uint32_t multiple_px = has_aims ? 64 : 2;
  std::vector<cv::Mat> pictures(robots.size());
  impl_->thread->run([&](RenderThread::Targets& targets) {
    CameraInfo pinhole;
    impl_->show(seen);
    mrpt::img::CImage picture;
    for (std::size_t i = 0; i < robots.size(); ++i) {
      const CameraView& view = view_of(i);
      if (i == 0 || has_aims) pinhole = view.hasErrors() ? pinholeFor(view, multiple_px) : view.info;
      CameraInfo rendered = pinhole;
      if (view.is_antialiased) {
        rendered.width_px *= 2;
        rendered.height_px *= 2;
      }
      auto& target = targets.ofSize(rendered.width_px, rendered.height_px);
      const TPose2D& robot = seen.world_from_robot[robots[i]];
      const CPose3D world_from_camera =
          CPose3D(robot.x, robot.y, impl_->underside_m[robots[i]], robot.phi, 0, 0) + CPose3D(view.robot_from_camera);
      target.setCamera(*impl_->scene, cameraAt(rendered, world_from_camera));
      target.render_RGB(*impl_->scene, picture);
      pictures[i] = picture.asCvMat<cv::Mat>(mrpt::img::DEEP_COPY);
      if (view.is_antialiased) {
        const cv::Size size(static_cast<int>(pinhole.width_px), static_cast<int>(pinhole.height_px));
        cv::resize(pictures[i], pictures[i], size, 0, 0, cv::INTER_AREA);
      }
    }
  });
  std::vector<unsigned char> bytes;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const CameraView& view = view_of(i);
    if (view.hasErrors()) {
      pictures[i] = withCameraErrors(pictures[i], view, camera.moment.turn_radps[i], camera.moment.seeds[i]);
    }
    cv::imencode(".jpg", pictures[i], bytes, {cv::IMWRITE_JPEG_QUALITY, view.jpeg_quality});
    jpegs[i].assign(bytes.begin(), bytes.end());
  }
}

std::vector<Blob> OffscreenRenderer::findBlobs(const std::string& jpeg, const std::vector<TargetColor>& colors,
                                               unsigned pixels_min) {
  return robosim::findBlobs(jpeg, colors, pixels_min);
}

cv::Mat OffscreenRenderer::picture(const CameraInfo& camera, const TPose3D& world_from_camera, const SeenWorld& seen,
                                   DepthBuffer* depth) {
  cv::Mat drawn;
  impl_->thread->run([&](RenderThread::Targets& targets) {
    auto& target = targets.ofSize(camera.width_px, camera.height_px);
    impl_->show(seen);
    target.setCamera(*impl_->scene, cameraAt(camera, CPose3D(world_from_camera)));
    mrpt::img::CImage picture;
    target.render_RGB(*impl_->scene, picture);
    drawn = picture.asCvMat<cv::Mat>(mrpt::img::DEEP_COPY);
    if (depth) *depth = {drawn.cols, drawn.rows, target.lastDepths()};
  });
  return drawn;
}

cv::Mat OffscreenRenderer::depth(const CameraInfo& camera, const TPose3D& world_from_camera, const SeenWorld& seen) {
  DepthBuffer buffer;
  picture(camera, world_from_camera, seen, &buffer);
  cv::Mat_<float> depths(buffer.height_px, buffer.width_px);
  for (int y = 0; y < depths.rows; ++y) {
    for (int x = 0; x < depths.cols; ++x) depths(y, x) = buffer.metresAt(x, y);
  }
  return depths;
}

std::unique_ptr<ImageSource> makeOffscreenRenderer(const World& world, const Fleet& fleet) {
  return std::make_unique<OffscreenRenderer>(world, fleet);
}

}  // namespace robosim
