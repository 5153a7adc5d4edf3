#include "rendering/plan.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "rendering/ground_painter.h"
#include "rendering/png_file.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr double kPathWidth_px = 1.6;
constexpr double kPathsBright = 0.07;  // share of the picture that paths may cover at full opacity
constexpr double kStartRadius_px = 4.5;
constexpr double kRobotRadiusMin_px = 3;  // minimum for large worlds

/// Draws one plan, from back to front.
class Drawing {
 public:
  Drawing(const World& world, const Fleet& fleet, PlanPaths paths,
          std::span<const mrpt::math::TPose2D> world_from_robot)
      : world_(world),
        fleet_(fleet),
        paths_(paths),
        world_from_robot_(world_from_robot),
        view_(planView(world, paths)),
        canvas_(view_, kPageColor) {}

  cv::Mat draw() {
    drawFloor(canvas_, world_.bounds);
    const float paleness = pathPaleness();
    for (std::size_t i = 0; i < paths_.size(); ++i) drawPath(i, paleness);
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      if (!paths_[i].empty()) drawStart(view_.toPixel(paths_[i].front()), colors_[i]);
    }
    drawMaps(canvas_, world_);
    drawObjects(canvas_, world_);
    for (std::size_t i = 0; i < world_from_robot_.size(); ++i) drawRobot(i);
    writeNames();
    writeLegend();
    return canvas_.pictureForFile();
  }

 private:
  TPoint2D robotPixel(std::size_t robot) const {
    return view_.toPixel({world_from_robot_[robot].x, world_from_robot_[robot].y});
  }

  /// [px]
  double robotRadius(std::size_t robot) const {
    return std::max(kRobotRadiusMin_px, fleet_.robots[robot].info.radius_m * view_.pixelsPerMetre());
  }

  /// Blend factor of paths towards the floor colour: grows with the share of the picture that they cover, so that
  /// objects stay visible.
  float pathPaleness() const {
    double length_m = 0;
    for (const auto& path : paths_) {
      for (std::size_t i = 1; i < path.size(); ++i) length_m += (path[i] - path[i - 1]).norm();
    }
    const double covered_px = length_m * view_.pixelsPerMetre() * kPathWidth_px;
    const double covered = covered_px / (view_.width() * view_.height());
    return static_cast<float>(std::clamp(1 - kPathsBright / covered, 0.0, 0.75));
  }

  void drawPath(std::size_t robot, float paleness) {
    std::vector<TPoint2D> path;
    for (const auto& point : paths_[robot]) path.push_back(view_.toPixel(point));
    if (path.empty()) return;
    if (robot < world_from_robot_.size()) path.push_back(robotPixel(robot));
    canvas_.polyline(path, kPathWidth_px + 1.6, kWhite);
    canvas_.polyline(path, kPathWidth_px, mix(colors_[robot], kFloorColor, paleness));
  }

  void drawStart(const TPoint2D& at, const Color& color) {
    canvas_.disc(at, kStartRadius_px, color);
    canvas_.disc(at, kStartRadius_px - 2, kWhite);
  }

  void drawRobot(std::size_t robot) {
    const double heading = world_from_robot_[robot].phi;
    robosim::drawRobot(canvas_, robotPixel(robot), robotRadius(robot), {std::cos(heading), -std::sin(heading)},
                       colors_[robot]);
  }

  void writeNames() {
    NameWriter names(canvas_);
    for (std::size_t i = 0; i < world_from_robot_.size(); ++i) {
      names.keepClear(robotPixel(i), robotRadius(i), robotRadius(i));
    }
    names.writeHotObjects(world_);
    for (std::size_t i = 0; i < world_from_robot_.size(); ++i) {
      names.write(fleet_.robots[i].info.name, robotPixel(i), robotRadius(i), robotRadius(i),
                  mix(colors_[i], {0, 0, 0}, 0.35f));
    }
  }

  void writeLegend() {
    canvas_.text({PlanView::kSideMargin_px, PlanView::kTopMargin_px / 2.0}, world_.name, 13, kInkColor);

    const double y = view_.height() - PlanView::kBottomMargin_px / 2.0;
    drawScale(canvas_, {PlanView::kSideMargin_px, y});

    const Color color = mix(kPageColor, kInkColor, 0.7f);
    double x = view_.width() - PlanView::kSideMargin_px;
    const auto put = [&](const std::string& word, double mark_width) {
      x -= Canvas::textWidth(word, kTextSize_px);
      canvas_.text({x, y}, word, kTextSize_px, kInkColor);
      x -= mark_width;
    };
    put("end", 16);
    robosim::drawRobot(canvas_, {x, y}, 8, {1, 0}, color);
    x -= 24;
    put("start", 14);
    drawStart({x, y}, color);
  }

  const World& world_;
  const Fleet& fleet_;
  PlanPaths paths_;
  std::span<const mrpt::math::TPose2D> world_from_robot_;
  PlanView view_;
  std::vector<Color> colors_ = robotColors(fleet_);  ///< by robot
  Canvas canvas_;
};

}  // namespace

Bounds2D planArea(const World& world, PlanPaths paths) {
  Bounds2D area = world.bounds;
  const auto include = [&](const Bounds2D& b) {
    area = {std::min(area.x_min, b.x_min), std::max(area.x_max, b.x_max), std::min(area.y_min, b.y_min),
            std::max(area.y_max, b.y_max)};
  };
  for (const auto& object : world.objects) include(boundsOf(object.body.solid().outline));
  for (const auto& map : world.maps) include(boundsOf(map.plan, map.world_from_map));
  for (const auto& path : paths) {
    for (const auto& point : path) include({point.x, point.x, point.y, point.y});
  }
  return area;
}

PlanView planView(const World& world, PlanPaths paths) { return PlanView(planArea(world, paths)); }

void writePlan(const std::filesystem::path& png, const World& world, const Fleet& fleet, PlanPaths paths,
               std::span<const mrpt::math::TPose2D> world_from_robot) {
  writePngFile(png, Drawing(world, fleet, paths, world_from_robot).draw());
}

void checkPlanFile(const std::filesystem::path& png) { checkPngFile(png); }

}  // namespace robosim
