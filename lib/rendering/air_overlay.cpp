#include "rendering/air_overlay.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <opencv2/imgproc.hpp>

#include "rendering/air_paths.h"
#include "rendering/air_view.h"
#include "rendering/bgr.h"
#include "rendering/canvas.h"
#include "rendering/free_areas.h"
#include "rendering/ground_painter.h"
#include "rendering/sensor_colors.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;

constexpr double kArcPiece_m = 0.2;  // of a sonar sector's arc
constexpr std::size_t kMaxAirNames = 60;

/// Tints horizontal areas at one height, where nothing nearer covers them.
class AirTint {
 public:
  AirTint(const AirPicture& air, const AirView& view, double z_m) : air_(air), view_(view), z_m_(z_m) {}

  /// @param corners world frame
  void add(const std::vector<TPoint2D>& corners) {
    std::vector<TPoint3D> ahead;  // the part in front of the camera (Sutherland & Hodgman 1974)
    TPoint3D last = view_.seen({corners.back().x, corners.back().y, z_m_});
    for (const auto& corner : corners) {
      const TPoint3D next = view_.seen({corner.x, corner.y, z_m_});
      if ((last.x < AirView::kNearest_m) != (next.x < AirView::kNearest_m)) {
        ahead.push_back(last + (next - last) * ((AirView::kNearest_m - last.x) / (next.x - last.x)));
      }
      if (next.x >= AirView::kNearest_m) ahead.push_back(next);
      last = next;
    }
    std::vector<cv::Point> polygon;
    for (const auto& point : ahead) {
      const TPoint2D pixel = view_.pixel(point);
      constexpr double kMost_px = 20000;
      polygon.push_back(rounded({std::clamp(pixel.x, -kMost_px, kMost_px), std::clamp(pixel.y, -kMost_px, kMost_px)}));
    }
    if (polygon.size() > 2) polygons_.push_back(std::move(polygon));
  }

  void draw(const Color& color, float opacity) const {
    cv::Rect area;
    for (const auto& polygon : polygons_)
      area = area.empty() ? cv::boundingRect(polygon) : area | cv::boundingRect(polygon);
    area &= cv::Rect({}, air_.picture.size());
    if (area.empty()) return;
    cv::Mat mask = cv::Mat::zeros(area.size(), CV_8U);
    for (const auto& polygon : polygons_) {
      cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{polygon}, cv::Scalar(255), cv::LINE_8, 0, -area.tl());
    }
    // The plane's 1 / depth is linear in the picture.
    const auto rotation = air_.world_from_camera.getRotationMatrix();
    const double above_m = z_m_ - air_.world_from_camera.z;
    if (std::abs(above_m) < 1e-6) return;
    const double per_x = -rotation(2, 1) / view_.focalLength() / above_m;
    const double per_y = -rotation(2, 2) / view_.focalLength() / above_m;
    const cv::Scalar paint = bgr(color);
    for (int y = 0; y < area.height; ++y) {
      const uchar* const covered = mask.ptr<uchar>(y);
      auto* const pixels = air_.picture.ptr<cv::Vec3b>(y + area.y) + area.x;
      const double row = rotation(2, 0) / above_m + per_y * (y + area.y - view_.middle().y);
      for (int x = 0; x < area.width; ++x) {
        if (covered[x] == 0) continue;
        const double inverse = row + per_x * (x + area.x - view_.middle().x);
        const float depth_m = view_.depthAt(x + area.x, y + area.y);
        if (depth_m > 0 && inverse * depth_m * 1.01 < 1) continue;
        for (int i = 0; i < 3; ++i)
          pixels[x][i] = cv::saturate_cast<uchar>(pixels[x][i] + opacity * (paint[i] - pixels[x][i]));
      }
    }
  }

 private:
  const AirPicture& air_;
  const AirView& view_;
  double z_m_;
  std::vector<std::vector<cv::Point>> polygons_;
};

constexpr double kBeforeEcho_m = 0.05;  ///< towards the robot, where an echo is tested for visibility

void drawRanges(const AirPicture& air, const AirView& view, const RunSnapshot& snapshot, const Fleet& fleet,
                const std::vector<std::uint8_t>& shown) {
  std::map<std::pair<SensorKind, double>, AirTint> tints;  // by kind and height
  struct Dot {
    TPoint3D at;
    TPoint3D before;  ///< on the beam, in front of the surface
    Color color;
  };
  std::vector<Dot> dots;
  for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
    const RobotSnapshot& robot = snapshot.robots[i];
    if (!robot.readings || !robot.isPresent() || (!shown.empty() && !shown[i])) continue;
    const auto& sensors = *fleet.robots[i].info.sensors;
    for (std::size_t k = 0; k < sensors.size(); ++k) {
      const auto* echoes = std::get_if<Echoes>(&robot.readings->measurements[k]);
      if (!echoes || echoes->empty() || sensors[k].beams.empty()) continue;
      const double z_m = sensors[k].beams.front().robot_from_beam.z;
      auto& tint = tints.try_emplace({sensors[k].kind, z_m}, air, view, z_m).first->second;
      for (const auto& area : freeAreas(robot, sensors[k], *echoes, kArcPiece_m)) tint.add(area);
      for (const auto& echo : *echoes) {
        if (echo.range_m >= sensors[k].range_max_m) continue;
        const TPoint2D in_robot(echo.point_m.x, echo.point_m.y);
        const TPoint2D back = in_robot * (-kBeforeEcho_m / std::max(kBeforeEcho_m, in_robot.norm()));
        const auto at = robot.world_from_robot.composePoint(in_robot);
        const auto before = robot.world_from_robot.composePoint(in_robot + back);
        dots.push_back(
            {{at.x, at.y, echo.point_m.z}, {before.x, before.y, echo.point_m.z}, sensorColor(sensors[k].kind)});
      }
    }
  }
  for (const auto& [what, tint] : tints) tint.draw(sensorColor(what.first), 0.17f);
  const int radius_px = std::max(1, static_cast<int>(std::lround(2 * air.scale)));
  for (const auto& dot : dots) {
    const TPoint3D seen = view.seen(dot.at);
    if (seen.x < AirView::kNearest_m) continue;
    const TPoint2D pixel = view.pixel(seen);
    // An echo lies on the surface that it was measured on, up to the measurement's error, and on the side of the robot:
    // walls 10 cm thick hide it from the other side.
    const TPoint3D seen_before = view.seen(dot.before);
    if (!view.isOnPicture(pixel) || !view.isVisible(pixel, seen_before.x, 0.05, 0.003)) continue;
    cv::circle(air.picture, rounded(pixel), radius_px, bgr(dot.color), cv::FILLED, cv::LINE_AA);
  }
}

/// Writes the robots' names above them, those of near robots first, without overlaps.
void writeNames(const AirPicture& air, const AirView& view, const RunSnapshot& snapshot, const Fleet& fleet,
                const std::vector<Color>& colors) {
  struct Label {
    double ahead_m;
    TPoint2D foot;
    std::size_t robot;
  };
  std::vector<Label> labels;
  for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
    if (!snapshot.robots[i].isPresent()) continue;
    const auto& pose = snapshot.robots[i].world_from_robot;
    const TPoint3D seen = view.seen({pose.x, pose.y, fleet.robots[i].body.heights().z_max_m + 0.12});
    if (seen.x < 4 * AirView::kNearest_m) continue;
    const TPoint2D pixel = view.pixel(seen);
    if (view.isOnPicture(pixel)) labels.push_back({seen.x, pixel, i});
  }
  if (labels.size() > kMaxAirNames) return;
  std::sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.ahead_m < b.ahead_m; });
  std::vector<cv::Rect> taken;
  const double text_px = kTextSize_px * air.scale;
  const Canvas measuring(cv::Mat(1, 1, CV_8UC3));
  for (const auto& label : labels) {
    const std::string& name = fleet.robots[label.robot].info.name;
    const int width = static_cast<int>(std::ceil(measuring.textWidth(name, text_px) + 8 * air.scale));
    const int height = static_cast<int>(std::ceil(text_px * 1.9));
    const cv::Rect place(static_cast<int>(label.foot.x) - width / 2, static_cast<int>(label.foot.y) - height, width,
                         height);
    if ((place & cv::Rect({}, air.picture.size())) != place ||
        std::any_of(taken.begin(), taken.end(), [&](const cv::Rect& other) { return !(other & place).empty(); })) {
      continue;
    }
    taken.push_back(place);
    Canvas canvas(air.picture(place));
    canvas.text({4 * air.scale, height / 2.0}, name, text_px, mix(colors[label.robot], {0, 0, 0}, 0.35f));
    canvas.picture().copyTo(air.picture(place));
  }
}

}  // namespace

void drawAirOverlay(const AirPicture& air, const RunSnapshot& snapshot, const Fleet& fleet, const RunPaths& paths,
                    const TopViewLayers& layers, const std::vector<std::uint8_t>& shown) {
  const AirView view(air);
  const auto colors = robotColors(fleet);
  if (layers.paths) drawAirPaths(air, view, snapshot, colors, paths, layers.paths_from_s);
  if (layers.sensors) drawRanges(air, view, snapshot, fleet, shown);
  if (layers.names) writeNames(air, view, snapshot, fleet, colors);
}

}  // namespace robosim
