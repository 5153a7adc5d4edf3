#include "rendering/air_overlay.h"

#include <cmath>
#include <optional>

#include <opencv2/imgproc.hpp>

#include "rendering/bgr.h"
#include "rendering/ground_painter.h"

namespace robosim {
namespace {

constexpr Color kEchoColor{0.86f, 0.20f, 0.25f};

/// A pinhole camera with square pixels.
class Projection {
 public:
  Projection(const CameraInfo& camera, const mrpt::math::TPose3D& world_from_camera)
      : world_from_camera_(world_from_camera),
        middle_(camera.width_px / 2.0, camera.height_px / 2.0),
        focal_px_(camera.focalLength()) {}

  /// nullopt behind the camera, and for points far outside the picture.
  std::optional<cv::Point> operator()(const mrpt::math::TPoint3D& world) const {
    mrpt::math::TPoint3D seen;
    world_from_camera_.inverseComposePoint(world, seen);
    constexpr double kNearest_m = 0.05, kMost_px = 20000;
    if (seen.x < kNearest_m) return std::nullopt;
    const double x = middle_.x - focal_px_ * seen.y / seen.x, y = middle_.y - focal_px_ * seen.z / seen.x;
    if (std::abs(x) > kMost_px || std::abs(y) > kMost_px) return std::nullopt;
    return cv::Point(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)));
  }

 private:
  mrpt::math::TPose3D world_from_camera_;
  mrpt::math::TPoint2D middle_;
  double focal_px_;
};

void drawPath(cv::Mat& picture, const Projection& project, const PathPart& part, const Color& color) {
  std::optional<cv::Point> before;
  for (const auto& point : part.points) {
    const auto here = project({point.at.x, point.at.y, 0});
    if (here && before && !point.is_after_gap) cv::line(picture, *before, *here, bgr(color), 2, cv::LINE_AA);
    before = here;
  }
}

void drawEchoes(cv::Mat& picture, const Projection& project, const RobotSnapshot& robot,
                const std::vector<SensorInfo>& sensors) {
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    const auto* echoes = std::get_if<Echoes>(&robot.readings->measurements[k]);
    if (!echoes) continue;
    for (const auto& echo : *echoes) {
      if (echo.range_m >= sensors[k].range_max_m) continue;
      const auto at = robot.world_from_robot.composePoint(mrpt::math::TPoint2D(echo.point_m.x, echo.point_m.y));
      const auto pixel = project({at.x, at.y, echo.point_m.z});
      if (pixel) cv::circle(picture, *pixel, 2, bgr(kEchoColor), cv::FILLED, cv::LINE_AA);
    }
  }
}

}  // namespace

void drawAirOverlay(cv::Mat& picture, const CameraInfo& camera, const mrpt::math::TPose3D& world_from_camera,
                    const RunSnapshot& snapshot, const Fleet& fleet, const RunPaths& paths,
                    const TopViewLayers& layers) {
  const Projection project(camera, world_from_camera);
  const auto colors = robotColors(fleet);
  for (std::size_t i = 0; layers.paths && i < snapshot.robots.size(); ++i) {
    drawPath(picture, project, paths.between(i, layers.paths_from_s, snapshot.time_s), colors[i]);
  }
  for (std::size_t i = 0; layers.sensors && i < snapshot.robots.size() && i < colors.size(); ++i) {
    if (snapshot.robots[i].readings) drawEchoes(picture, project, snapshot.robots[i], *fleet.robots[i].info.sensors);
  }
}

}  // namespace robosim
