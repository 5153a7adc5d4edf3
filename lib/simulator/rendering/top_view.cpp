#include "rendering/top_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <mrpt/core/format.h>

#include "hardware/led_color.h"
#include "rendering/density_painter.h"
#include "rendering/detail_level.h"
#include "rendering/drawing_surface.h"
#include "rendering/free_areas.h"
#include "rendering/ground_painter.h"
#include "rendering/path_fading.h"
#include "rendering/sensor_colors.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr Color kStallColor{0.80f, 0.05f, 0.05f};
constexpr double kPath_px = 2.2;  ///< width
/// Maximum number of visible robots whose names are drawn.
constexpr std::size_t kMaxNames = 60;

constexpr double kArcPiece_px = 8;  ///< straight piece of a sonar sector's arc

DrawingSurface emptyFloor(const World& world, const ChangedObjects& objects, const GroundView& view, double scale) {
  DrawingSurface surface(view, kPageColor, scale);
  drawFloor(surface, world.bounds);
  drawFloorAreas(surface, world, objects.orThose(world.objects));
  return surface;
}

void drawObjectsAndMaps(DrawingSurface& surface, const World& world, const ChangedObjects& objects) {
  drawMaps(surface, world);
  drawObjects(surface, objects.orThose(world.objects));
}

/// Draws one picture, from back to front.
class Drawing {
 public:
  /// @param objects layer with the objects on the floor; null to draw them
  /// @param followed robot that the view follows, which is drawn with its readings also among many robots
  /// @param density drawn on the floor, in place of the robots and paths of a crowded picture; must outlive this
  Drawing(const World& world, const Fleet& fleet, const RunSnapshot& snapshot, DrawingSurface floor,
          const DrawingSurface* objects, std::optional<std::size_t> followed, const std::optional<DensityMap>& density)
      : world_(world),
        fleet_(fleet),
        snapshot_(snapshot),
        view_(floor.view()),
        surface_(std::move(floor)),
        objects_(objects),
        followed_(followed),
        density_(density),
        level_(levelOf()) {}

  cv::Mat draw(const RunPaths& paths, const ViewLayers& layers) {
    if (density_) drawDensity(surface_, *density_);
    if (layers.paths && level_.is_crowded && level_.has_paths) drawTrails(paths, layers);
    if (layers.paths && !level_.is_crowded) drawPaths(paths, layers);
    if (layers.sensors) drawRanges();
    if (objects_) {
      surface_.lay(*objects_);
    } else {
      drawObjectsAndMaps(surface_, world_, snapshot_.objects);
    }
    for (std::size_t i = 0; i < snapshot_.robots.size() && level_.has_robots; ++i) {
      if (i != followed_ || !level_.is_crowded) drawRobot(i, layers.events);
    }
    if (followed_ && level_.is_crowded) drawFollowed(*followed_);
    if (layers.sensors) drawTouch();
    if (layers.names) writeNames();
    writeLegend();
    return surface_.picture();
  }

 private:
  DetailLevel levelOf() const {
    std::size_t seen = 0;
    for (const auto& robot : snapshot_.robots) {
      if (robot.isPresent() && isOnPicture(pixelOf(robot.world_from_robot), 0)) ++seen;
    }
    const Bounds2D& bounds = world_.bounds;
    const TPoint2D low = view_.toPixel({bounds.x_min, bounds.y_max}),
                   high = view_.toPixel({bounds.x_max, bounds.y_min});
    const double width_px = std::min<double>(high.x, view_.width()) - std::max(low.x, 0.0);
    const double height_px = std::min<double>(high.y, view_.height()) - std::max(low.y, 0.0);
    return DetailLevel::of(seen, std::max(0.0, width_px) * std::max(0.0, height_px), density_.has_value());
  }

  /// Whether the readings of a robot are drawn.
  bool showsReadings(std::size_t robot) const { return !level_.is_crowded || followed_ == robot; }

  TPoint2D pixelOf(const TPose2D& pose) const { return view_.toPixel({pose.x, pose.y}); }
  double radiusPx(std::size_t robot) const {
    return std::max(level_.radius_min_px, fleet_.robots[robot].info.radius_m * view_.pixelsPerMetre());
  }
  bool isOnPicture(const TPoint2D& pixel, double margin_px) const {
    return pixel.x > -margin_px && pixel.y > -margin_px && pixel.x < view_.width() + margin_px &&
           pixel.y < view_.height() + margin_px;
  }

  /// A piece of a path on the picture.
  struct Stroke {
    std::size_t robot;
    std::vector<TPoint2D> points;
  };

  /// Draws the paths. Where old ones would cover much of the picture (many robots, long runs), they fade towards the
  /// floor, and only the last seconds keep their full colour.
  void drawPaths(const RunPaths& paths, const ViewLayers& layers) {
    constexpr float kPaleness = 0.35f;
    const double from_s = layers.paths_from_s, recent_from_s = std::max(from_s, snapshot_.time_s - kRecentPath_s);
    std::vector<Stroke> old, recent;
    for (std::size_t i = 0; i < snapshot_.robots.size(); ++i) {
      if (!layers.shows(i)) continue;
      addStrokes(old, i, paths.between(i, from_s, recent_from_s), paths.positionAt(i, recent_from_s));
      if (!snapshot_.robots[i].isPresent()) continue;
      const auto& pose = snapshot_.robots[i].world_from_robot;
      addStrokes(recent, i, paths.between(i, recent_from_s, snapshot_.time_s), TPoint2D(pose.x, pose.y));
    }
    double length_px = 0;
    for (const auto& stroke : old) {
      for (std::size_t k = 1; k < stroke.points.size(); ++k)
        length_px += (stroke.points[k] - stroke.points[k - 1]).norm();
    }
    const double covered = length_px * kPath_px / (1.0 * view_.width() * view_.height());
    drawStrokes(old, kPath_px, std::max(kPaleness, pathFading(covered)));
    drawStrokes(recent, kPath_px, kPaleness);
  }

  void drawStrokes(const std::vector<Stroke>& strokes, double width_px, float paleness) {
    for (const auto& stroke : strokes)
      surface_.polyline(stroke.points, width_px, mix(colors_[stroke.robot], kFloorColor, paleness));
  }

  /// Draws the last seconds of the paths of many robots, which fade with age.
  void drawTrails(const RunPaths& paths, const ViewLayers& layers) {
    constexpr float kNewest = 0.35f;
    const double from_s = std::max(layers.paths_from_s, snapshot_.time_s - kRecentPath_s);
    const auto parts = trailParts(from_s, snapshot_.time_s, kNewest);
    for (const auto& part : parts) {
      std::vector<Stroke> strokes;
      for (std::size_t i = 0; i < snapshot_.robots.size(); ++i) {
        const RobotSnapshot& robot = snapshot_.robots[i];
        if (!layers.shows(i) || !robot.isPresent() || !isOnPicture(pixelOf(robot.world_from_robot), 200)) continue;
        const bool is_newest = &part == &parts.back();
        const TPoint2D now(robot.world_from_robot.x, robot.world_from_robot.y);
        addStrokes(strokes, i, paths.between(i, part.from_s, part.to_s),
                   is_newest ? now : paths.positionAt(i, part.to_s));
      }
      drawStrokes(strokes, kPath_px * level_.path_share, part.paleness);
    }
  }

  /// Draws a robot among many so that it is found.
  void drawFollowed(std::size_t i) {
    constexpr double kFollowed_px = 6;
    const RobotSnapshot& robot = snapshot_.robots[i];
    if (!robot.isPresent()) return;
    const double radius = std::max(kFollowed_px, radiusPx(i)), heading = robot.world_from_robot.phi;
    const TPoint2D center = pixelOf(robot.world_from_robot);
    surface_.disc(center, radius + 2, kWhite);
    robosim::drawRobot(surface_, center, radius, {std::cos(heading), -std::sin(heading)}, colors_[i]);
  }

  /// Adds the visible pieces of a part of a path, which ends at `end` if that is known.
  void addStrokes(std::vector<Stroke>& strokes, std::size_t robot, const PathPart& part,
                  const std::optional<TPoint2D>& end) const {
    constexpr double kStride_px = 1.5;
    Stroke stroke{robot, {}};
    const auto finish = [&] {
      if (stroke.points.size() > 1) strokes.push_back(stroke);
      stroke.points.clear();
    };
    if (part.begin) stroke.points.push_back(view_.toPixel(*part.begin));
    for (const auto& point : part.points) {
      const TPoint2D pixel = view_.toPixel(point.at);
      if (point.is_after_gap) finish();
      if (stroke.points.empty() || (pixel - stroke.points.back()).norm() >= kStride_px) stroke.points.push_back(pixel);
    }
    if (end && !stroke.points.empty()) stroke.points.push_back(view_.toPixel(*end));
    finish();
  }

  /// Draws regions measured as free, with a tint per kind of sensor, and dots at echoes.
  void drawRanges() {
    struct Dot {
      TPoint2D at;
      Color color;
    };
    std::vector<Dot> dots;
    std::vector<std::vector<TPoint2D>> free[3];
    const SensorKind kinds[] = {SensorKind::sonar, SensorKind::laser, SensorKind::infrared};
    forEachEchoes(fleet_, snapshot_, [&](const RobotSnapshot& robot, const SensorInfo& sensor, const Echoes& echoes) {
      if (!showsReadings(static_cast<std::size_t>(&robot - snapshot_.robots.data()))) return;
      auto& areas = free[std::find(std::begin(kinds), std::end(kinds), sensor.kind) - std::begin(kinds)];
      for (auto& area : freeAreas(robot, sensor, echoes, kArcPiece_px / view_.pixelsPerMetre())) {
        for (auto& corner : area) corner = view_.toPixel(corner);
        areas.push_back(std::move(area));
      }
      for (const auto& echo : echoes) {
        if (echo.range_m < sensor.range_max_m) {
          dots.push_back({toPixel(robot, {echo.point_m.x, echo.point_m.y}), sensorColor(sensor.kind)});
        }
      }
    });
    for (std::size_t i = 0; i < std::size(kinds); ++i) surface_.fillUnion(free[i], sensorColor(kinds[i]), 0.17);
    forEachSightLines(fleet_, snapshot_, [&](const RobotSnapshot& robot, const SensorInfo& sensor, const auto& lines) {
      if (!showsReadings(static_cast<std::size_t>(&robot - snapshot_.robots.data()))) return;
      const Color color = sensorColor(sensor.kind);
      for (const auto& line : lines) {
        std::vector<TPoint2D> pixels;
        for (const auto& point : line) pixels.push_back(view_.toPixel(point));
        surface_.polyline(pixels, 1, mix(color, kFloorColor, 0.35f));
        if (line.size() == 2) dots.push_back({pixels.back(), color});
      }
    });
    for (const auto& dot : dots) {
      if (isOnPicture(dot.at, 2)) surface_.dot(dot.at, 1.6, dot.color);
    }
  }

  TPoint2D toPixel(const RobotSnapshot& robot, const TPoint2D& in_robot) const {
    return view_.toPixel(robot.world_from_robot.composePoint(in_robot));
  }

  void drawRobot(std::size_t i, bool with_events) {
    const RobotSnapshot& robot = snapshot_.robots[i];
    const TPoint2D center = pixelOf(robot.world_from_robot);
    const double radius = radiusPx(i);
    if (!robot.isPresent() || !isOnPicture(center, radius + 8)) return;
    // Among many robots a rim no wider than the robot; gold is rare.
    const double rim_px = level_.is_crowded ? std::min(3.0, radius / 2) : 3;
    if (robot.stalled && with_events) surface_.disc(center, radius + rim_px, kStallColor);
    if (robot.activity == Activity::found && with_events) surface_.disc(center, radius + 3.5, kGlowColor);
    const Color color = robot.activity == Activity::active ? colors_[i] : mix(colors_[i], {0.5f, 0.5f, 0.5f}, 0.6f);
    const double heading = robot.world_from_robot.phi;
    const auto draw = level_.is_crowded ? drawRobotOfMany : robosim::drawRobot;
    draw(surface_, center, radius, {std::cos(heading), -std::sin(heading)}, color);
    if (robot.led_color == 0) return;
    const auto lit = radius < 6 ? &DrawingSurface::dot : &DrawingSurface::disc;
    if (radius >= 6) (surface_.*lit)(center, radius * 0.6, kWhite);
    (surface_.*lit)(center, radius >= 6 ? radius * 0.6 - 1 : radius, rgbOf(robot.led_color));
  }

  /// Draws bumper contacts as arcs on the rim, and heat as a number with a bar.
  void drawTouch() {
    for (std::size_t i = 0; i < snapshot_.robots.size(); ++i) {
      const RobotSnapshot& robot = snapshot_.robots[i];
      if (!robot.readings || !robot.isPresent() || !showsReadings(i)) continue;
      if (!isOnPicture(pixelOf(robot.world_from_robot), 100)) continue;
      const auto& info = fleet_.robots[i].info;
      for (std::size_t k = 0; k < info.sensors->size(); ++k) {
        const SensorInfo& sensor = (*info.sensors)[k];
        const Measurement& measured = robot.readings->measurements[k];
        if (sensor.kind == SensorKind::bumper) drawContacts(robot, info, sensor, std::get<Contacts>(measured));
        if (sensor.kind == SensorKind::heat) drawHeat(i, std::get<Scalar>(measured).value);
      }
    }
  }

  void drawContacts(const RobotSnapshot& robot, const RobotInfo& info, const SensorInfo& sensor,
                    const Contacts& contacts) {
    for (std::size_t i = 0; i < contacts.pressed.size(); ++i) {
      if (!contacts.pressed[i]) continue;
      const double middle_rad = sensor.beams[i].robot_from_beam.yaw;
      std::vector<TPoint2D> arc;
      for (int k = -4; k <= 4; ++k) {
        const double angle_rad = middle_rad + sensor.beam_width_rad * k / 8;
        arc.push_back(toPixel(robot, {info.radius_m * std::cos(angle_rad), info.radius_m * std::sin(angle_rad)}));
      }
      surface_.polyline(arc, 4, kStallColor);
    }
  }

  void drawHeat(std::size_t i, double heat) {
    if (heat < 0.5) return;
    const TPoint2D center = pixelOf(snapshot_.robots[i].world_from_robot);
    surface_.text({center.x + radiusPx(i) * 0.7 + 4, center.y + radiusPx(i) * 0.7 + 8}, mrpt::format("heat %.0f", heat),
                  kTextSize_px, mix(kGlowColor, {0.5f, 0, 0}, 0.5f));
  }

  void writeNames() {
    NameWriter names(surface_);
    names.keepClear({0, 0}, 330, 34);
    std::vector<std::size_t> seen;
    for (std::size_t i = 0; i < snapshot_.robots.size(); ++i) {
      const TPoint2D center = pixelOf(snapshot_.robots[i].world_from_robot);
      if (!snapshot_.robots[i].isPresent() || !isOnPicture(center, 0)) continue;
      names.keepClear(center, radiusPx(i), radiusPx(i));
      seen.push_back(i);
    }
    names.writeHotObjects(snapshot_.objects.orThose(world_.objects));
    if (seen.size() > kMaxNames || level_.is_crowded) return;
    for (const std::size_t i : seen) {
      names.write(fleet_.robots[i].info.name, pixelOf(snapshot_.robots[i].world_from_robot), radiusPx(i), radiusPx(i),
                  mix(colors_[i], {0, 0, 0}, 0.35f));
    }
  }

  void writeLegend() {
    surface_.text({12, 16},
                  mrpt::format("%s   %.1f s   step %llu", world_.name.c_str(), snapshot_.time_s,
                               static_cast<unsigned long long>(snapshot_.step)),
                  11, kInkColor);
    drawScale(surface_, {14, view_.height() - 18.0});
    if (density_) drawDensityLegend(surface_, *density_);
  }

  const World& world_;
  const Fleet& fleet_;
  const RunSnapshot& snapshot_;
  GroundView view_;
  std::vector<Color> colors_ = robotColors(fleet_);  ///< by robot
  DrawingSurface surface_;
  const DrawingSurface* objects_;
  std::optional<std::size_t> followed_;
  const std::optional<DensityMap>& density_;
  DetailLevel level_;
};

}  // namespace

/// Layers that stay the same while the view does not move: most of the work.
struct TopView::StaticLayers {
  DrawingSurface floor, objects;
};

TopView::TopView(const World& world, const Fleet& fleet) : world_(world), fleet_(fleet) {}
TopView::~TopView() = default;

TopViewCamera TopViewCamera::showing(const Bounds2D& area, int width_px, int height_px) {
  constexpr double kMargin_px = 24;
  TopViewCamera camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.center = {(area.x_min + area.x_max) / 2, (area.y_min + area.y_max) / 2};
  const auto scale = [&](double size_m, int size_px) {
    return std::max(1.0, size_px - 2 * kMargin_px) / std::max(1e-3, size_m);
  };
  camera.px_per_m = std::min(scale(area.x_max - area.x_min, width_px), scale(area.y_max - area.y_min, height_px));
  return camera;
}

void TopViewCamera::zoom(double factor, const TPoint2D& pixel) {
  const double before = px_per_m;
  px_per_m = std::clamp(px_per_m * factor, 0.01, 5000.0);
  // Relative to the picture's centre, in metres, y up.
  const TPoint2D off((pixel.x - (width_px - 1) / 2.0), -(pixel.y - (height_px - 1) / 2.0));
  center += off * (1 / before - 1 / px_per_m);
}

GroundView TopView::groundView(const RunSnapshot& snapshot, const TopViewCamera& camera) {
  TPoint2D center = camera.center;
  if (camera.follow && *camera.follow < snapshot.robots.size()) {
    const auto& pose = snapshot.robots[*camera.follow].world_from_robot;
    center = {pose.x, pose.y};
  }
  return {camera.width_px, camera.height_px, center, camera.px_per_m};
}

cv::Mat TopView::draw(const RunSnapshot& snapshot, const RunPaths& paths, const TopViewCamera& camera,
                      const ViewLayers& layers) {
  const GroundView view = groundView(snapshot, camera);
  const std::optional<DensityMap> density = densityOf(layers, world_, fleet_, snapshot, paths);
  const bool has_same_objects = snapshot.objects.isSameList(last_objects_);
  last_objects_ = snapshot.objects;
  if (std::exchange(last_view_, view) != view || std::exchange(last_scale_, camera.scale) != camera.scale ||
      !has_same_objects) {
    static_layers_.reset();
    return Drawing(world_, fleet_, snapshot, emptyFloor(world_, snapshot.objects, view, camera.scale), nullptr,
                   camera.follow, density)
        .draw(paths, layers);
  }
  if (!static_layers_) {
    DrawingSurface objects(view, std::nullopt, camera.scale);
    drawObjectsAndMaps(objects, world_, snapshot.objects);
    static_layers_ = std::make_unique<StaticLayers>(
        StaticLayers{emptyFloor(world_, snapshot.objects, view, camera.scale), std::move(objects)});
  }
  return Drawing(world_, fleet_, snapshot, static_layers_->floor, &static_layers_->objects, camera.follow, density)
      .draw(paths, layers);
}

std::optional<std::size_t> TopView::robotAt(const TPoint2D& pixel, const RunSnapshot& snapshot, const Fleet& fleet,
                                            const TopViewCamera& camera) {
  const GroundView view = groundView(snapshot, camera);
  for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
    if (!snapshot.robots[i].isPresent()) continue;
    const auto& pose = snapshot.robots[i].world_from_robot;
    const double radius = std::max(6.0, fleet.robots[i].info.radius_m * view.pixelsPerMetre());
    if ((view.toPixel({pose.x, pose.y}) - pixel).norm() <= radius) return i;
  }
  return std::nullopt;
}

}  // namespace robosim
