#include "rendering/plan.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <mrpt/core/format.h>

#include "rendering/canvas.h"
#include "rendering/png_file.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr Color kPage{0.922f, 0.941f, 0.961f};
constexpr Color kFloor{1, 1, 1};
constexpr Color kGrid{0.882f, 0.902f, 0.922f};
constexpr Color kInk{0.16f, 0.18f, 0.22f};
constexpr Color kGlow{1.0f, 0.55f, 0.15f};
constexpr Color kWhite{1, 1, 1};

constexpr double kTextSize_px = 10;  // height of a capital
constexpr double kPathWidth_px = 1.6;
constexpr double kPathsBright = 0.07;  // share of the picture that paths may cover in their full colours
constexpr double kStartRadius_px = 4.5;
constexpr double kRobotRadiusMin_px = 3;  // in a wide world a robot to scale would be lost

/// Colours that stay apart beside each other: eight well-known ones first, then hues in steps of the golden angle.
Color pathColor(std::size_t robot) {
  static constexpr Color kFirst[] = {{0.84f, 0.15f, 0.16f}, {0.12f, 0.42f, 0.75f}, {0.17f, 0.57f, 0.22f},
                                     {0.56f, 0.27f, 0.68f}, {0.93f, 0.46f, 0.05f}, {0.07f, 0.60f, 0.65f},
                                     {0.83f, 0.22f, 0.58f}, {0.49f, 0.36f, 0.22f}};
  if (robot < std::size(kFirst)) return kFirst[robot];
  const double hue = std::fmod(static_cast<double>(robot) * 0.381966, 1) * 6;
  Color color;
  for (std::size_t i = 0; i < 3; ++i) {
    const double offset = std::fmod(hue + 2.0 * static_cast<double>(3 - i), 6) - 3;
    color[i] = static_cast<float>(std::clamp(std::abs(offset) - 1, 0.0, 1.0)) * 0.75f + 0.05f;
  }
  return color;
}

Bounds2D around(const TPoint2D& center, double half_width, double half_height) {
  return {center.x - half_width, center.x + half_width, center.y - half_height, center.y + half_height};
}

bool cover(const Bounds2D& a, const Bounds2D& b) {
  return a.x_min < b.x_max && b.x_min < a.x_max && a.y_min < b.y_max && b.y_min < a.y_max;
}

bool inside(const Bounds2D& inner, const Bounds2D& outer) {
  return outer.contains({inner.x_min, inner.y_min}) && outer.contains({inner.x_max, inner.y_max});
}

/// Draws one plan, from the ground up.
class Drawing {
 public:
  Drawing(const World& world, const Fleet& fleet, PlanPaths paths,
          std::span<const mrpt::math::TPose2D> world_from_robot)
      : world_(world),
        fleet_(fleet),
        paths_(paths),
        world_from_robot_(world_from_robot),
        view_(planView(world, paths)),
        canvas_(view_, kPage) {}

  cv::Mat draw() {
    drawFloor();
    const float paleness = pathPaleness();
    for (std::size_t i = 0; i < paths_.size(); ++i) drawPath(i, paleness);
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      if (!paths_[i].empty()) drawStart(view_.toPixel(paths_[i].front()), pathColor(i));
    }
    for (const auto& map : world_.maps) drawMap(map);
    drawObjects();
    for (std::size_t i = 0; i < world_from_robot_.size(); ++i) drawRobot(i);
    writeNames();
    writeLegend();
    return canvas_.picture();
  }

 private:
  void drawFloor() {
    const Bounds2D& b = world_.bounds;
    const mrpt::math::TPose2D center{(b.x_min + b.x_max) / 2, (b.y_min + b.y_max) / 2, 0};
    const Outline floor = OrientedBox::from(center, b.x_max - b.x_min, b.y_max - b.y_min);
    canvas_.fill(floor, kFloor);
    constexpr double kGridMin_px = 32;
    const double cell_m = roundLengthUpTo(2 * kGridMin_px / view_.pixelsPerMetre());
    for (double x = std::ceil(b.x_min / cell_m) * cell_m; x <= b.x_max; x += cell_m) {
      canvas_.line(view_.toPixel({x, b.y_min}), view_.toPixel({x, b.y_max}), 1, kGrid);
    }
    for (double y = std::ceil(b.y_min / cell_m) * cell_m; y <= b.y_max; y += cell_m) {
      canvas_.line(view_.toPixel({b.x_min, y}), view_.toPixel({b.x_max, y}), 1, kGrid);
    }
    canvas_.outline(floor, 1, mix(kGrid, kInk, 0.3f));
  }

  void drawMap(const WorldMap& map) {
    std::vector<Solid> solids;
    addSolids(map.plan, map.world_from_map, map.heights(), solids);
    for (const auto& solid : solids) canvas_.fill(solid.outline, map.color);
    // A map's walls may be thinner than can be seen.
    for (std::size_t i = map.plan.occupied.size(); i < solids.size(); ++i) {
      canvas_.outline(solids[i].outline, 1.5, map.color);
    }
  }

  void drawObjects() {
    std::vector<const Body*> bodies;
    for (const auto& object : world_.objects) bodies.push_back(&object.body);
    std::stable_sort(bodies.begin(), bodies.end(),
                     [](const Body* a, const Body* b) { return a->heights().z_max_m < b->heights().z_max_m; });
    for (const Body* body : bodies) {
      if (body->heat_celsius > 0) canvas_.glow(body->solid().outline, 26, kGlow);
    }
    for (const Body* body : bodies) {
      const Outline shape = body->solid().outline;
      canvas_.fill(shape, body->color);
      canvas_.outline(shape, 1, mix(body->color, {0, 0, 0}, 0.45f));
    }
  }

  TPoint2D robotPixel(std::size_t robot) const {
    return view_.toPixel({world_from_robot_[robot].x, world_from_robot_[robot].y});
  }

  /// [px]
  double robotRadius(std::size_t robot) const {
    return std::max(kRobotRadiusMin_px, fleet_.robots[robot].info.radius_m * view_.pixelsPerMetre());
  }

  /// How far paths fade into the floor: the more of it they would cover, so that what stands on it can be seen.
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
    std::vector<TPoint2D> way;
    for (const auto& point : paths_[robot]) way.push_back(view_.toPixel(point));
    if (way.empty()) return;
    if (robot < world_from_robot_.size()) way.push_back(robotPixel(robot));
    canvas_.polyline(way, kPathWidth_px + 1.6, kWhite);
    canvas_.polyline(way, kPathWidth_px, mix(pathColor(robot), kFloor, paleness));
  }

  void drawStart(const TPoint2D& at, const Color& color) {
    canvas_.disc(at, kStartRadius_px, color);
    canvas_.disc(at, kStartRadius_px - 2, kWhite);
  }

  void drawRobot(std::size_t robot) {
    const double heading = world_from_robot_[robot].phi;
    drawRobot(robotPixel(robot), robotRadius(robot), {std::cos(heading), -std::sin(heading)}, pathColor(robot));
  }

  void drawRobot(const TPoint2D& center, double radius_px, const TPoint2D& ahead, const Color& color) {
    canvas_.disc(center, radius_px, mix(color, {0, 0, 0}, 0.5f));
    canvas_.disc(center, radius_px - 1, color);
    const bool small = radius_px < 6;  // too small to draw in
    canvas_.line(center, center + ahead * (radius_px + (small ? 4 : -1.5)), 2, small ? color : kWhite);
  }

  void writeNames() {
    for (std::size_t i = 0; i < world_from_robot_.size(); ++i) {
      taken_.push_back(around(robotPixel(i), robotRadius(i), robotRadius(i)));
    }
    for (const auto& object : world_.objects) {
      if (object.body.heat_celsius <= 0) continue;
      const Bounds2D b = boundsOf(object.body.solid().outline);
      const auto& pose = object.body.world_from_body;
      writeName(object.name, view_.toPixel({pose.x, pose.y}), (b.x_max - b.x_min) / 2 * view_.pixelsPerMetre(),
                (b.y_max - b.y_min) / 2 * view_.pixelsPerMetre(), mix(kGlow, {0.3f, 0, 0}, 0.6f));
    }
    for (std::size_t i = 0; i < world_from_robot_.size(); ++i) {
      writeName(fleet_.robots[i].info.name, robotPixel(i), robotRadius(i), robotRadius(i),
                mix(pathColor(i), {0, 0, 0}, 0.35f));
    }
  }

  /// Writes a name beside a thing, on the calmest of the places where it covers no robot and no other name; nowhere if
  /// there is none.
  void writeName(const std::string& name, const TPoint2D& center, double half_width, double half_height,
                 const Color& color) {
    const double width = Canvas::textWidth(name, kTextSize_px);
    const double height = kTextSize_px * 1.4;
    const double right = half_width + 5 + width / 2, up = half_height + 4 + height / 2;
    const TPoint2D offsets[] = {{right, 0},        {-right, 0},         {0, -up},          {0, up}, {right * 0.8, -up},
                                {right * 0.8, up}, {-right * 0.8, -up}, {-right * 0.8, up}};
    std::optional<Bounds2D> best;
    double best_unrest = 0;
    for (const auto& offset : offsets) {
      const Bounds2D place = around(center + offset, width / 2 + 2, height / 2);
      if (!inside(place, around({view_.width() / 2.0, view_.height() / 2.0}, view_.width() / 2.0 - 2,
                                view_.height() / 2.0 - 2)) ||
          std::any_of(taken_.begin(), taken_.end(), [&](const Bounds2D& other) { return cover(place, other); })) {
        continue;
      }
      const double unrest = canvas_.unrest(place);
      if (best && unrest >= best_unrest) continue;
      best = place;
      best_unrest = unrest;
    }
    if (!best) return;
    taken_.push_back(*best);
    canvas_.text({best->x_min + 2, (best->y_min + best->y_max) / 2}, name, kTextSize_px, color);
  }

  void writeLegend() {
    canvas_.text({PlanView::kSideMargin_px, PlanView::kTopMargin_px / 2.0}, world_.name, 13, kInk);

    const double y = view_.height() - PlanView::kBottomMargin_px / 2.0;
    const double scale_m = roundLengthUpTo(160 / view_.pixelsPerMetre());
    const double from = PlanView::kSideMargin_px, to = from + scale_m * view_.pixelsPerMetre();
    canvas_.line({from, y}, {to, y}, 2, kInk);
    canvas_.line({from, y - 5}, {from, y + 5}, 2, kInk);
    canvas_.line({to, y - 5}, {to, y + 5}, 2, kInk);
    canvas_.text({to + 10, y}, mrpt::format("%g m", scale_m), kTextSize_px, kInk);

    const Color color = mix(kPage, kInk, 0.7f);
    double x = view_.width() - PlanView::kSideMargin_px;
    const auto put = [&](const std::string& word, double mark_width) {
      x -= Canvas::textWidth(word, kTextSize_px);
      canvas_.text({x, y}, word, kTextSize_px, kInk);
      x -= mark_width;
    };
    put("end", 16);
    drawRobot({x, y}, 8, {1, 0}, color);
    x -= 24;
    put("start", 14);
    drawStart({x, y}, color);
  }

  const World& world_;
  const Fleet& fleet_;
  PlanPaths paths_;
  std::span<const mrpt::math::TPose2D> world_from_robot_;
  PlanView view_;
  Canvas canvas_;
  std::vector<Bounds2D> taken_;  ///< rectangles of pixels that no further name may cover
};

}  // namespace

PlanView planView(const World& world, PlanPaths paths) {
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
  return PlanView(area);
}

void writePlan(const std::filesystem::path& png, const World& world, const Fleet& fleet, PlanPaths paths,
               std::span<const mrpt::math::TPose2D> world_from_robot) {
  writePngFile(png, Drawing(world, fleet, paths, world_from_robot).draw());
}

void checkPlanFile(const std::filesystem::path& png) { checkPngFile(png); }

}  // namespace robosim
