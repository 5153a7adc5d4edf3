#include "rendering/air_overlay.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "rendering/air_paths.h"
#include "rendering/air_view.h"
#include "rendering/density_painter.h"
#include "rendering/detail_level.h"
#include "rendering/drawing_surface.h"
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
    std::vector<TPoint2D> polygon;
    for (const auto& point : ahead) {
      const TPoint2D pixel = view_.pixel(point);
      constexpr double kMost_px = 20000;
      polygon.emplace_back(std::clamp(pixel.x, -kMost_px, kMost_px), std::clamp(pixel.y, -kMost_px, kMost_px));
    }
    if (polygon.size() > 2) polygons_.push_back(std::move(polygon));
  }

  void draw(DrawingSurface& surface, const Color& color, double opacity) const {
    if (polygons_.empty()) return;
    // The plane's 1 / depth is linear in the picture.
    const auto rotation = air_.world_from_camera.getRotationMatrix();
    const double above_m = z_m_ - air_.world_from_camera.z;
    if (std::abs(above_m) < 1e-6) return;
    const double per_x = -rotation(2, 1) / view_.focalLength() / above_m;
    const double per_y = -rotation(2, 2) / view_.focalLength() / above_m;
    cv::Mat covered = surface.coverage(polygons_);
    for (int y = 0; y < covered.rows; ++y) {
      auto* const pixels = covered.ptr<std::uint8_t>(y);
      const double row = rotation(2, 0) / above_m + per_y * (y - view_.middle().y);
      for (int x = 0; x < covered.cols; ++x) {
        if (pixels[x] == 0) continue;
        const double inverse = row + per_x * (x - view_.middle().x);
        const float depth_m = view_.depthAt(x, y);
        if (depth_m > 0 && inverse * depth_m * 1.01 < 1) pixels[x] = 0;
      }
    }
    surface.fillMask(covered, color, opacity);
  }

 private:
  const AirPicture& air_;
  const AirView& view_;
  double z_m_;
  std::vector<std::vector<TPoint2D>> polygons_;
};

/// Draws lines of sightLines() at the height of their sensor, where nothing nearer covers them.
void drawSightLines(DrawingSurface& surface, const AirView& view, const std::vector<std::vector<TPoint2D>>& lines,
                    const SensorInfo& sensor, double width_px) {
  const double z_m = sensor.beams.empty() ? 0 : sensor.beams.front().robot_from_beam.z;
  const Color color = sensorColor(sensor.kind);
  for (const auto& line : lines) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      constexpr double kPiece_m = 0.25;
      const TPoint2D way = line[i] - line[i - 1];
      const int pieces = std::clamp(static_cast<int>(std::ceil(way.norm() / kPiece_m)), 1, 400);
      for (int k = 0; k < pieces; ++k) {
        const TPoint2D from = line[i - 1] + way * (1.0 * k / pieces), to = line[i - 1] + way * ((k + 1.0) / pieces);
        const TPoint3D a = view.seen({from.x, from.y, z_m}), b = view.seen({to.x, to.y, z_m});
        if (a.x < AirView::kNearest_m || b.x < AirView::kNearest_m) continue;
        const TPoint2D middle = view.pixel((a + b) * 0.5);
        if (!view.isOnPicture(middle) || !view.isVisible(middle, (a.x + b.x) / 2, 0.05)) continue;
        surface.line(view.pixel(a), view.pixel(b), width_px, color);
      }
    }
  }
}

constexpr double kBeforeEcho_m = 0.05;  ///< towards the robot, where an echo is tested for visibility

void drawRanges(DrawingSurface& surface, const AirPicture& air, const AirView& view, const RunSnapshot& snapshot,
                const Fleet& fleet, const std::vector<std::uint8_t>& shown) {
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
      drawSightLines(surface, view, sightLines(robot, sensors[k], robot.readings->measurements[k]), sensors[k],
                     air.scale);
      if (!echoes || echoes->empty()) continue;
      if (!sensors[k].beams.empty()) {  // else a cloud of points
        const double z_m = sensors[k].beams.front().robot_from_beam.z;
        auto& tint = tints.try_emplace({sensors[k].kind, z_m}, air, view, z_m).first->second;
        for (const auto& area : freeAreas(robot, sensors[k], *echoes, kArcPiece_m)) tint.add(area);
      }
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
  for (const auto& [what, tint] : tints) tint.draw(surface, sensorColor(what.first), 0.17);
  for (const auto& dot : dots) {
    const TPoint3D seen = view.seen(dot.at);
    if (seen.x < AirView::kNearest_m) continue;
    const TPoint2D pixel = view.pixel(seen);
    // An echo lies on the surface that it was measured on, up to the measurement's error, and on the side of the robot:
    // walls 10 cm thick hide it from the other side.
    const TPoint3D seen_before = view.seen(dot.before);
    if (!view.isOnPicture(pixel) || !view.isVisible(pixel, seen_before.x, 0.05, 0.003)) continue;
    surface.dot(pixel, 2 * air.scale, dot.color);
  }
}

/// Writes the robots' names, those of near robots first, without overlaps: above a robot, or else beside or below it.
void writeNames(DrawingSurface& surface, const AirPicture& air, const AirView& view, const RunSnapshot& snapshot,
                const Fleet& fleet, const std::vector<Color>& colors) {
  struct Label {
    double ahead_m;
    TPoint2D foot;              ///< above the robot
    double half_px, height_px;  ///< of the robot on the picture
    std::size_t robot;
  };
  std::vector<Label> labels;
  for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
    if (!snapshot.robots[i].isPresent()) continue;
    const auto& pose = snapshot.robots[i].world_from_robot;
    const TPoint3D seen = view.seen({pose.x, pose.y, fleet.robots[i].body().heights().z_max_m + 0.12});
    if (seen.x < 4 * AirView::kNearest_m) continue;
    const TPoint2D pixel = view.pixel(seen);
    const TPoint3D ground = view.seen({pose.x, pose.y, fleet.robots[i].body().heights().z_min_m});
    const double height_px = ground.x < AirView::kNearest_m ? 0 : view.pixel(ground).y - pixel.y;
    const double half_px = fleet.robots[i].info.radius_m * view.focalLength() / seen.x;
    if (view.isOnPicture(pixel)) labels.push_back({seen.x, pixel, half_px, height_px, i});
  }
  if (labels.size() > kMaxAirNames) return;
  std::sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.ahead_m < b.ahead_m; });
  std::vector<cv::Rect> taken;
  const double text_px = kTextSize_px * air.scale;
  for (const auto& label : labels) {
    const std::string& name = fleet.robots[label.robot].info.name;
    const int width = static_cast<int>(std::ceil(surface.textWidth(name, text_px) + 8 * air.scale));
    const int height = static_cast<int>(std::ceil(text_px * 1.9));
    const auto is_free = [&](const cv::Rect& place) {
      return (place & cv::Rect({}, air.picture.size())) == place &&
             std::none_of(taken.begin(), taken.end(), [&](const cv::Rect& other) { return !(other & place).empty(); });
    };
    const int x = static_cast<int>(label.foot.x), y = static_cast<int>(label.foot.y);
    const int beside = static_cast<int>(std::ceil(label.half_px + 4 * air.scale));
    const int below = static_cast<int>(std::ceil(label.height_px + 4 * air.scale));
    const cv::Point places[] = {{x - width / 2, y - height},      // above
                                {x - width / 4, y - height},      // above, to the right
                                {x - 3 * width / 4, y - height},  // above, to the left
                                {x + beside, y},                  // right
                                {x - beside - width, y},          // left
                                {x - width / 2, y + below}};      // below
    const auto* const found = std::find_if(std::begin(places), std::end(places), [&](const cv::Point& at) {
      return is_free(cv::Rect(at, cv::Size(width, height)));
    });
    if (found == std::end(places)) continue;
    const cv::Rect place(*found, cv::Size(width, height));
    taken.push_back(place);
    surface.text({place.x + 4 * air.scale, place.y + height / 2.0}, name, text_px,
                 mix(colors[label.robot], {0, 0, 0}, 0.35f));
  }
}

/// The level of detail by the rectangle that contains the robots on the picture.
DetailLevel levelOf(const AirView& view, const RunSnapshot& snapshot, bool has_density) {
  std::size_t count = 0;
  TPoint2D low, high;
  for (const auto& robot : snapshot.robots) {
    if (!robot.isPresent()) continue;
    const TPoint3D seen = view.seen({robot.world_from_robot.x, robot.world_from_robot.y, 0});
    if (seen.x < AirView::kNearest_m) continue;
    const TPoint2D pixel = view.pixel(seen);
    if (!view.isOnPicture(pixel)) continue;
    low = count == 0 ? pixel : TPoint2D(std::min(low.x, pixel.x), std::min(low.y, pixel.y));
    high = count == 0 ? pixel : TPoint2D(std::max(high.x, pixel.x), std::max(high.y, pixel.y));
    ++count;
  }
  return DetailLevel::of(count, (high.x - low.x) * (high.y - low.y), has_density);
}

/// Marks those of many robots that are too small on the picture to be seen with a dot in their colour.
void drawDots(DrawingSurface& surface, const AirPicture& air, const AirView& view, const RunSnapshot& snapshot,
              const Fleet& fleet, const std::vector<Color>& colors, const DetailLevel& level) {
  const double radius_px = level.radius_min_px * air.scale;
  for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
    if (!snapshot.robots[i].isPresent()) continue;
    const auto& pose = snapshot.robots[i].world_from_robot;
    const double top_m = fleet.robots[i].body().heights().z_max_m;
    const TPoint3D seen = view.seen({pose.x, pose.y, top_m});
    if (seen.x < AirView::kNearest_m) continue;
    const TPoint2D pixel = view.pixel(seen);
    if (fleet.robots[i].info.radius_m * view.focalLength() / seen.x >= radius_px) continue;
    if (!view.isOnPicture(pixel) || !view.isVisible(pixel, seen.x, 2 * fleet.robots[i].info.radius_m)) continue;
    surface.dot(pixel, radius_px, colors[i]);
  }
}

/// Flags of the robots whose readings are drawn: with many robots only of those in `shown`.
std::vector<std::uint8_t> selectShown(const std::vector<std::uint8_t>& shown, std::size_t robots,
                                      const DetailLevel& level) {
  return shown.empty() && level.is_crowded ? std::vector<std::uint8_t>(robots, 0) : shown;
}

}  // namespace

void drawAirOverlay(const AirPicture& air, const RunSnapshot& snapshot, const Fleet& fleet, const RunPaths& paths,
                    const ViewLayers& layers, const std::vector<std::uint8_t>& shown,
                    const std::optional<DensityMap>& density) {
  const AirView view(air);
  const auto colors = robotColors(fleet);
  const DetailLevel level = levelOf(view, snapshot, density.has_value());
  if (density) tintGround(air, *density);
  DrawingSurface surface(air.picture);
  if (layers.paths && level.has_paths) drawAirPaths(surface, air, view, snapshot, colors, paths, layers, level);
  if (layers.sensors)
    drawRanges(surface, air, view, snapshot, fleet, selectShown(shown, snapshot.robots.size(), level));
  if (level.is_crowded) {
    if (level.has_robots) drawDots(surface, air, view, snapshot, fleet, colors, level);
  } else if (layers.names) {
    writeNames(surface, air, view, snapshot, fleet, colors);
  }
  if (density) drawDensityLegend(surface, *density, air.scale);
  surface.copyTo(air.picture);
}

}  // namespace robosim
