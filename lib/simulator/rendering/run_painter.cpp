#include "rendering/run_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "rendering/density_painter.h"
#include "rendering/path_fading.h"
#include "rendering/sensor_colors.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr float kNewestTrail = 0.5f;   ///< paleness of the newest parts of the paths of many robots, at most
constexpr double kPathsBright = 0.07;  // share of the picture that paths may cover at full opacity
constexpr double kStartRadius_px = kStartMark_px / 2;
constexpr double kTint = 0.17, kTintMin = 0.03;  ///< opacity of areas measured as free
constexpr double kEchoRadius_px = 1.1;
constexpr double kSight_px = 0.8;  ///< width of lines to landmarks, and of circles through beacons
constexpr float kSightPaleness = 0.35f;
constexpr double kMarkSpacing_px = 14;
constexpr double kMarkRadius_px = 7;
constexpr Color kGoldColor{1.0f, 0.80f, 0.10f};
constexpr Color kStopColor{0.80f, 0.05f, 0.05f};

/// Area of a polygon, by the shoelace formula.
double sizeOf(std::span<const TPoint2D> corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const TPoint2D &a = corners[i], &b = corners[(i + 1) % corners.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return std::abs(twice) / 2;
}

/// A star with five points.
std::array<TPoint2D, 10> star(const TPoint2D& center, double radius_px) {
  std::array<TPoint2D, 10> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double angle_rad = static_cast<double>(i) * M_PI / 5 - M_PI / 2;
    const double from_center_px = i % 2 == 0 ? radius_px : 0.45 * radius_px;
    corners[i] = center + TPoint2D(std::cos(angle_rad), std::sin(angle_rad)) * from_center_px;
  }
  return corners;
}

}  // namespace

RunPainter::RunPainter(Figure& figure, const World& world, const Fleet& fleet, const DrawnRun& run, const Style& style)
    : figure_(figure),
      view_(figure.view()),
      world_(world),
      fleet_(fleet),
      run_(run),
      style_(style),
      level_(detailOf(world, run, view_.pixelsPerMetre())),
      colors_(robotColors(fleet)) {
  style_.path_px *= level_.path_share;
}

void RunPainter::paintGround() {
  const auto& objects = run_.objects.orThose(world_.objects);
  drawFloor(figure_, world_.bounds);
  drawFloorAreas(figure_, world_, objects);
  if (run_.density) drawDensity(figure_, *run_.density);
  paintFreeAreas();
  const float paleness = pathPaleness();
  if (level_.is_crowded) {
    paintTrails(std::min(paleness, kNewestTrail));
  } else {
    for (std::size_t i = 0; i < run_.paths.size(); ++i) paintPath(i, paleness);
  }
  for (std::size_t i = 0; i < run_.paths.size() && run_.has_starts; ++i) {
    if (!run_.paths[i].empty()) paintStart(view_.toPixel(run_.paths[i].front()), colors_[i]);
  }
  paintEchoes();
  paintSightLines();
  drawMaps(figure_, world_);
  drawObjects(figure_, objects);
}

void RunPainter::paintFreeAreas() {
  // Where many areas overlap, each is paler.
  double covered_m2 = 0;
  for (const auto& sensed : run_.sensed) {
    for (const auto& area : sensed.free) covered_m2 += sizeOf(area);
  }
  const double floor_m2 = (world_.bounds.x_max - world_.bounds.x_min) * (world_.bounds.y_max - world_.bounds.y_min);
  const double opacity = covered_m2 > floor_m2 ? std::max(kTintMin, kTint * floor_m2 / covered_m2) : kTint;
  for (const auto& sensed : run_.sensed) {
    for (const auto& area : sensed.free) figure_.polygon(toPixels(area), sensorColor(sensed.kind), opacity);
  }
}

void RunPainter::paintEchoes() {
  for (const auto& sensed : run_.sensed) {
    figure_.discs(toPixels(sensed.echoes), kEchoRadius_px, sensorColor(sensed.kind));
  }
}

void RunPainter::paintSightLines() {
  for (const auto& sensed : run_.sensed) {
    const Color color = mix(sensorColor(sensed.kind), kFloorColor, kSightPaleness);
    for (const auto& line : sensed.lines) {
      figure_.polyline(toPixels(line), kSight_px, color);
      if (line.size() == 2) figure_.disc(view_.toPixel(line.back()), 2 * kEchoRadius_px, sensorColor(sensed.kind));
    }
  }
}

std::vector<TPoint2D> RunPainter::toPixels(std::span<const TPoint2D> places) const {
  std::vector<TPoint2D> pixels;
  pixels.reserve(places.size());
  for (const auto& place : places) pixels.push_back(view_.toPixel(place));
  return pixels;
}

void RunPainter::paintRobots() {
  if (level_.is_crowded) paintSmallEvents();
  if (!level_.has_robots) return;
  for (std::size_t i = 0; i < run_.world_from_robot.size(); ++i) {
    const auto at = robotPixel(i);
    if (!at) continue;
    const double heading_rad = run_.world_from_robot[i]->phi;
    const auto draw = level_.is_crowded ? drawRobotOfMany : drawRobot;
    draw(figure_, *at, robotRadius(i), {std::cos(heading_rad), -std::sin(heading_rad)}, colors_[i]);
  }
}

/// Calls paint(event, pixel) for the events, of several of one robot and kind within a mark's size only the first.
template <typename Paint>
void RunPainter::forEachEvent(const Paint& paint) const {
  std::map<std::pair<RunEvent::Kind, std::size_t>, TPoint2D> last;
  for (const auto& event : run_.events) {
    const TPoint2D at = view_.toPixel(event.at);
    const auto [before, is_first] = last.try_emplace({event.kind, event.robot}, at);
    if (!is_first && (at - before->second).norm() < kMarkSpacing_px) continue;
    before->second = at;
    paint(event, at);
  }
}

void RunPainter::paintEvents() {
  forEachEvent([&](const RunEvent& event, const TPoint2D& at) {
    if (level_.is_crowded && event.kind != RunEvent::Kind::gold) return;
    marks_.push_back(besideRobots(at));
    paintEvent(event.kind, marks_.back(), colors_[event.robot]);
  });
}

void RunPainter::paintSmallEvents() {
  forEachEvent([&](const RunEvent& event, const TPoint2D& at) {
    if (event.kind != RunEvent::Kind::gold) paintSmallEvent(event.kind, at, colors_[event.robot]);
  });
}

TPoint2D RunPainter::besideRobots(const TPoint2D& at) const {
  for (std::size_t i = 0; i < run_.world_from_robot.size(); ++i) {
    const auto robot = robotPixel(i);
    if (!robot || (at - *robot).norm() > robotRadius(i)) continue;
    std::optional<TPoint2D> best;
    double best_contrast = 0;
    for (int k = 0; k < 8; ++k) {
      const double angle_rad = -M_PI / 4 + k * M_PI / 4;  // to the upper right first
      const TPoint2D place =
          *robot + TPoint2D(std::cos(angle_rad), std::sin(angle_rad)) * (robotRadius(i) + kMarkRadius_px + 1);
      const double half_px = kMarkRadius_px - 1.5;
      const double contrast =
          figure_.contrast({place.x - half_px, place.x + half_px, place.y - half_px, place.y + half_px});
      if (best && contrast >= best_contrast) continue;
      best = place;
      best_contrast = contrast;
    }
    return *best;
  }
  return at;
}

void RunPainter::paintNames() {
  if (!run_.has_names) return;
  NameWriter names = style_.names_within ? NameWriter(figure_, style_.text_px, *style_.names_within)
                                         : NameWriter(figure_, style_.text_px);
  for (const auto& mark : marks_) names.keepClear(mark, kMarkRadius_px, kMarkRadius_px);
  for (std::size_t i = 0; i < run_.world_from_robot.size(); ++i) {
    if (const auto at = robotPixel(i)) names.keepClear(*at, robotRadius(i), robotRadius(i));
  }
  names.writeHotObjects(run_.objects.orThose(world_.objects));
  if (level_.is_crowded) return;
  for (const std::size_t i : fromOutside()) {
    names.write(fleet_.robots[i].info.name, *robotPixel(i), robotRadius(i), robotRadius(i),
                mix(colors_[i], {0, 0, 0}, 0.35f));
  }
}

/// The drawn robots, the farthest from the middle of all first, which have most room for their names around them.
std::vector<std::size_t> RunPainter::fromOutside() const {
  std::vector<std::size_t> robots;
  TPoint2D middle;
  for (std::size_t i = 0; i < run_.world_from_robot.size(); ++i) {
    if (!run_.world_from_robot[i]) continue;
    robots.push_back(i);
    middle += *robotPixel(i);
  }
  middle *= 1.0 / static_cast<double>(std::max<std::size_t>(1, robots.size()));
  std::stable_sort(robots.begin(), robots.end(), [&](std::size_t a, std::size_t b) {
    return (*robotPixel(a) - middle).norm() > (*robotPixel(b) - middle).norm();
  });
  return robots;
}

void RunPainter::paintStart(const TPoint2D& at, const Color& color) {
  figure_.disc(at, kStartRadius_px, color);
  figure_.disc(at, kStartRadius_px - 2, kWhite);
}

void RunPainter::paintEnd(const TPoint2D& at, const Color& color) {
  drawRobot(figure_, at, kEndMark_px / 2, {1, 0}, color);
}

void RunPainter::paintSensor(SensorKind kind, const TPoint2D& at) {
  const double half = kSensorMark_px / 2;
  if (kind == SensorKind::beacons || kind == SensorKind::values) {
    const Color color = mix(sensorColor(kind), kFloorColor, kSightPaleness);
    std::vector<TPoint2D> line{{at.x - half, at.y}, {at.x + half, at.y}};
    if (kind == SensorKind::beacons) {
      line.clear();
      for (int k = 0; k <= 36; ++k) {
        line.push_back(at + TPoint2D(std::cos(k * M_PI / 18), std::sin(k * M_PI / 18)) * (half * 0.7));
      }
    }
    figure_.polyline(line, kSight_px, color);
    if (kind == SensorKind::values) figure_.disc(line.back(), 2 * kEchoRadius_px, sensorColor(kind));
    return;
  }
  const TPoint2D sector[] = {{at.x - half, at.y}, {at.x + half, at.y - half / 2}, {at.x + half, at.y + half / 2}};
  figure_.polygon(sector, sensorColor(kind), 2 * kTint);
}

void RunPainter::paintDensityScale(const TPoint2D& at) { drawDensityScale(figure_, at); }

void RunPainter::paintEvent(RunEvent::Kind kind, const TPoint2D& at, const Color& color) {
  switch (kind) {
    case RunEvent::Kind::gold:
      figure_.polygon(star(at, 10), kWhite);
      figure_.polygon(star(at, 8.5), mix(kGoldColor, {0, 0, 0}, 0.45f));
      figure_.polygon(star(at, 6.5), kGoldColor);
      break;
    case RunEvent::Kind::message: {
      const auto diamond = [&](double size_px, const Color& paint) {
        const TPoint2D corners[] = {
            {at.x, at.y - size_px}, {at.x + size_px, at.y}, {at.x, at.y + size_px}, {at.x - size_px, at.y}};
        figure_.polygon(corners, paint);
      };
      diamond(7.5, kWhite);
      diamond(6, mix(color, {0, 0, 0}, 0.25f));
      diamond(3.5, kWhite);
      break;
    }
    case RunEvent::Kind::stall:
      for (const auto& [width_px, paint] : {std::pair{4.0, kWhite}, std::pair{1.8, kStopColor}}) {
        paintCross(at, 3.5, width_px, paint);
      }
      break;
  }
}

void RunPainter::paintSmallEvent(RunEvent::Kind kind, const TPoint2D& at, const Color& color) {
  constexpr double half_px = 1.5;
  if (kind == RunEvent::Kind::stall) return paintCross(at, half_px, 0.8, mix(kStopColor, kFloorColor, 0.45f));
  const TPoint2D corners[] = {
      {at.x, at.y - half_px}, {at.x + half_px, at.y}, {at.x, at.y + half_px}, {at.x - half_px, at.y}};
  figure_.polygon(corners, mix(color, {0, 0, 0}, 0.25f));
}

void RunPainter::paintCross(const TPoint2D& at, double half_px, double width_px, const Color& color) {
  figure_.line({at.x - half_px, at.y - half_px}, {at.x + half_px, at.y + half_px}, width_px, color);
  figure_.line({at.x - half_px, at.y + half_px}, {at.x + half_px, at.y - half_px}, width_px, color);
}

std::optional<TPoint2D> RunPainter::robotPixel(std::size_t robot) const {
  const auto& pose = run_.world_from_robot[robot];
  if (!pose) return std::nullopt;
  return view_.toPixel({pose->x, pose->y});
}

double RunPainter::robotRadius(std::size_t robot) const {
  return std::max(level_.radius_min_px, fleet_.robots[robot].info.radius_m * view_.pixelsPerMetre());
}

/// Blend factor of paths towards the floor colour: grows with the share of the picture that they cover, so that
/// objects stay visible.
float RunPainter::pathPaleness() const {
  double length_m = 0;
  for (const auto& path : run_.paths) {
    for (std::size_t i = 1; i < path.size(); ++i) {
      if (!isGap(path[i]) && !isGap(path[i - 1])) length_m += (path[i] - path[i - 1]).norm();
    }
  }
  const double covered_px = length_m * view_.pixelsPerMetre() * style_.path_px;
  const double covered = covered_px / (view_.width() * view_.height());
  const double bright = std::min(kPathsBright, level_.path_coverage);
  return static_cast<float>(std::clamp(1 - bright / covered, 0.0, level_.is_crowded ? 0.85 : 0.75));
}

void RunPainter::paintPath(std::size_t robot, float paleness) {
  std::vector<TPoint2D> path = toPixels(run_.paths[robot]);
  if (path.empty()) return;
  if (robot < run_.world_from_robot.size()) {
    if (const auto end = robotPixel(robot)) path.push_back(*end);
  }
  const Color color = mix(colors_[robot], kFloorColor, paleness);
  for (const auto& [width_px, paint] : {std::pair{style_.path_px + 1.6, kWhite}, std::pair{style_.path_px, color}}) {
    for (auto begin = path.begin(); begin != path.end();) {
      const auto end = std::find_if(begin, path.end(), isGap);
      figure_.polyline({begin, end}, width_px, paint);
      begin = std::find_if_not(end, path.end(), isGap);
    }
  }
}

/// The paths of many robots, older parts paler and below newer ones of all robots. They have no rims, which would cut
/// the other paths into pieces.
void RunPainter::paintTrails(float newest) {
  const auto time_of = [&](std::size_t robot, std::size_t point) {
    return robot < run_.path_times_s.size() ? run_.path_times_s[robot][point] : static_cast<double>(point);
  };
  double from_s = std::numeric_limits<double>::infinity(), to_s = -from_s;
  for (std::size_t i = 0; i < run_.paths.size(); ++i) {
    if (run_.paths[i].empty()) continue;
    from_s = std::min(from_s, time_of(i, 0));
    to_s = std::max(to_s, time_of(i, run_.paths[i].size() - 1));
  }
  const auto parts = trailParts(from_s, to_s, newest);
  for (const auto& part : parts) {
    for (std::size_t i = 0; i < run_.paths.size(); ++i) {
      const auto& path = run_.paths[i];
      const Color color = mix(colors_[i], kFloorColor, part.paleness);
      std::vector<TPoint2D> piece;
      const auto finish = [&] {
        if (piece.size() > 1) figure_.polyline(piece, style_.path_px, color);
        piece.clear();
      };
      for (std::size_t k = 0; k < path.size(); ++k) {
        if (isGap(path[k])) {
          finish();
          continue;
        }
        // A line between two points belongs to the part in which it ends.
        const double time_s = time_of(i, k);
        const bool is_older = time_s < part.from_s;
        if (is_older) piece.clear();
        if (!is_older && time_s > part.to_s) break;
        piece.push_back(view_.toPixel(path[k]));
      }
      const bool is_newest = &part == &parts.back();
      if (is_newest && i < run_.world_from_robot.size() && !piece.empty()) {
        if (const auto end = robotPixel(i)) piece.push_back(*end);
      }
      finish();
    }
  }
}

}  // namespace robosim
