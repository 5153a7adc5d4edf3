#include "rendering/panes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "hardware/camera_head.h"
#include "rendering/air_overlay.h"
#include "rendering/detail_level.h"
#include "rendering/drawing_surface.h"
#include "rendering/ground_painter.h"
#include "rendering/snapshot_run.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using mrpt::math::TPose3D;

constexpr int kGap_px = 4;
/// Maximum number of robots for which all readings are shown; beyond it, only those of followed robots.
constexpr std::size_t kMaxWithReadings = 20;
constexpr double kFollowRadius_m = 6;  ///< initial radius shown around a followed robot

/// Height of the tallest object of a world.
double computeTop(const World& world) {
  double top_m = 0;
  for (const auto& object : world.objects) top_m = std::max(top_m, object.body.heights().z_max_m);
  for (const auto& map : world.maps) top_m = std::max(top_m, map.heights().z_max_m);
  return top_m;
}

/// Distance from the target at which a world fits into the camera's picture.
double distanceToShow(const World& world, const OrbitCamera& air, double width_px, double height_px) {
  constexpr double kMargin = 1.03;
  const double half_width = std::tan(air.field_of_view_rad / 2) / kMargin;  // of the picture at a distance of 1 m
  const double half_height = half_width * height_px / width_px;
  const TPose3D from_target = [&] {
    OrbitCamera at_target = air;
    at_target.distance_m = 0;
    return at_target.worldFromCamera(nullptr);
  }();
  const Bounds2D& b = world.bounds;
  double distance_m = 0.3;
  for (const double x : {b.x_min, b.x_max}) {
    for (const double y : {b.y_min, b.y_max}) {
      for (const double z : {0.0, computeTop(world)}) {
        // Forward, left and up from the target, in the camera's axes.
        mrpt::math::TPoint3D corner;
        from_target.inverseComposePoint({x, y, z}, corner);
        const double ahead_m = std::max(std::abs(corner.y) / half_width, std::abs(corner.z) / half_height);
        distance_m = std::max(distance_m, ahead_m - corner.x);
      }
    }
  }
  return distance_m;
}

}  // namespace

TPose3D OrbitCamera::worldFromCamera(const TPose2D* robot) const {
  const TPoint2D at = robot ? TPoint2D(robot->x, robot->y) : target;
  const double from_rad = robot ? robot->phi + azimuth_rad + M_PI / 2 + M_PI : azimuth_rad;
  const double level_m = distance_m * std::cos(elevation_rad);
  return {at.x + level_m * std::cos(from_rad),
          at.y + level_m * std::sin(from_rad),
          distance_m * std::sin(elevation_rad),
          from_rad + M_PI,
          elevation_rad,  // MRPT's pitch is positive downwards
          0};
}

Pane makePane(bool is_3d, std::optional<std::size_t> follow, const World& world) {
  Pane pane;
  pane.is_3d = is_3d;
  pane.follow = follow;
  const Bounds2D& b = world.bounds;
  pane.air.target = {(b.x_min + b.x_max) / 2, (b.y_min + b.y_max) / 2};
  if (follow) pane.air.distance_m = 4;  // else computed when the size is known
  pane.air.elevation_rad = follow ? 0.45 : 0.85;
  return pane;
}

Panes::Panes(const World& world, const Fleet& fleet, std::vector<Pane> panes, Draw3d draw_3d)
    : world_(world), fleet_(fleet), panes_(std::move(panes)), draw_3d_(std::move(draw_3d)), top_view_(world, fleet) {}

void Panes::resize(int width_px, int height_px) {
  if (width_px == width_px_ && height_px == height_px_ && look_.scale == fitted_scale_) return;
  fitted_scale_ = look_.scale;
  const bool is_first = width_px_ == 0;
  width_px_ = width_px;
  height_px_ = height_px;
  for (std::size_t i = 0; i < panes_.size(); ++i) {
    setTopSize(panes_[i], i);
    if (is_first) fit(panes_[i], i);
  }
}

void Panes::setTopSize(Pane& pane, std::size_t index) const {
  const cv::Rect rect = rectOf(index);
  pane.top.scale = look_.scale;
  pane.top.width_px = std::max(1, static_cast<int>(std::lround(rect.width / look_.scale)));
  pane.top.height_px = std::max(1, static_cast<int>(std::lround(rect.height / look_.scale)));
}

void Panes::fit(Pane& pane, std::size_t index) const {
  const cv::Rect rect = rectOf(index);
  setTopSize(pane, index);
  pane.top = TopViewCamera::showing(world_.bounds, pane.top.width_px, pane.top.height_px);
  pane.top.scale = look_.scale;
  pane.top.follow = pane.follow;
  if (pane.follow) {
    pane.top.px_per_m = std::max(pane.top.px_per_m, std::min(pane.top.width_px, pane.top.height_px) / kFollowRadius_m);
  }
  pane.air = makePane(pane.is_3d, pane.follow, world_).air;
  if (!pane.follow) pane.air.distance_m = distanceToShow(world_, pane.air, rect.width, rect.height);
}

cv::Rect Panes::rectOf(std::size_t pane) const {
  const auto count = static_cast<int>(panes_.size());
  const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
  const int rows = (count + columns - 1) / columns;
  const int row = static_cast<int>(pane) / columns;
  // The last row may have fewer panes, which are wider.
  const int in_row = row == rows - 1 ? count - row * columns : columns;
  const int column = static_cast<int>(pane) - row * columns;
  const auto edge = [](int i, int of, int length) { return (length + kGap_px) * i / of; };
  const int left = edge(column, in_row, width_px_);
  const int top = edge(row, rows, height_px_);
  return {left, top, std::max(1, edge(column + 1, in_row, width_px_) - kGap_px - left),
          std::max(1, edge(row + 1, rows, height_px_) - kGap_px - top)};
}

cv::Mat Panes::draw(const RunSnapshot& whole, const RunPaths& paths) {
  std::optional<RunSnapshot> of_shown;
  if (!layers_.only.empty()) of_shown = onlyShown(whole, layers_);
  const RunSnapshot& snapshot = of_shown ? *of_shown : whole;
  cv::Mat picture;
  if (panes_.size() == 1) {
    picture = drawPane(0, snapshot, paths);
  } else {
    picture = cv::Mat(height_px_, width_px_, CV_8UC3, cv::Scalar(90, 80, 75));
    for (std::size_t i = 0; i < panes_.size(); ++i) drawPane(i, snapshot, paths).copyTo(picture(rectOf(i)));
  }
  if (look_.camera_inset) drawInset(picture, whole);
  return picture;
}

CameraInfo Panes::airCamera(std::size_t pane) const {
  const cv::Rect rect = rectOf(pane);
  CameraInfo camera;
  camera.width_px = static_cast<std::uint32_t>(rect.width);
  camera.height_px = static_cast<std::uint32_t>(rect.height);
  camera.field_of_view_rad = panes_[pane].air.field_of_view_rad;
  return camera;
}

TPose3D Panes::worldFromAirCamera(const Pane& pane, const RunSnapshot& snapshot) const {
  return pane.air.worldFromCamera(pane.follow ? &snapshot.robots[*pane.follow].world_from_robot : nullptr);
}

cv::Mat Panes::drawPane(std::size_t index, const RunSnapshot& snapshot, const RunPaths& paths) {
  const Pane& pane = panes_[index];
  const cv::Rect rect = rectOf(index);
  if (!pane.is_3d) {
    cv::Mat picture = top_view_.draw(snapshot, paths, pane.top, layers_);
    // Scales that are not whole numbers may miss the size by a pixel.
    if (picture.size() != rect.size()) cv::resize(picture, picture, rect.size(), 0, 0, cv::INTER_LINEAR);
    return picture;
  }
  const CameraInfo camera = airCamera(index);
  const TPose3D world_from_camera = worldFromAirCamera(pane, snapshot);
  const bool has_overlay =
      !snapshot.robots.empty() && (layers_.paths || layers_.sensors || layers_.names || layers_.density ||
                                   layers_.visits || snapshot.robots.size() > DetailLevel::kManyRobots);
  DepthBuffer depth;
  cv::Mat picture = render(camera, world_from_camera, snapshot, has_overlay ? &depth : nullptr);
  if (has_overlay && !depth.empty()) {
    drawAirOverlay({picture, depth, camera, world_from_camera, look_.scale}, snapshot, fleet_, paths, layers_,
                   requestedReadings(), densityOf(layers_, world_, fleet_, snapshot, paths));
  }
  return picture;
}

cv::Mat Panes::render(CameraInfo camera, const TPose3D& world_from_camera, const RunSnapshot& snapshot,
                      DepthBuffer* depth) {
  std::vector<TPose2D> world_from_robot;
  for (const auto& robot : snapshot.robots) world_from_robot.push_back(robot.shownPose());
  if (!look_.antialias) return draw_3d_(camera, world_from_camera, {world_from_robot, snapshot.objects}, depth);
  const cv::Size size(static_cast<int>(camera.width_px), static_cast<int>(camera.height_px));
  camera.width_px *= 2;
  camera.height_px *= 2;
  cv::Mat picture = draw_3d_(camera, world_from_camera, {world_from_robot, snapshot.objects}, depth);
  cv::resize(picture, picture, size, 0, 0, cv::INTER_AREA);
  return picture;
}

void Panes::drawInset(cv::Mat& picture, const RunSnapshot& snapshot) {
  const auto camera_of = [&](std::size_t robot) -> const SensorInfo* {
    for (const auto& sensor : *fleet_.robots[robot].info.sensors) {
      if (sensor.kind == SensorKind::camera && !sensor.beams.empty()) return &sensor;
    }
    return nullptr;
  };
  const auto can_show = [&](std::size_t i) {
    return layers_.shows(i) && snapshot.robots[i].isPresent() && camera_of(i);
  };
  std::optional<std::size_t> robot;
  for (const auto& pane : panes_) {
    if (!robot && pane.follow && can_show(*pane.follow)) robot = pane.follow;
  }
  for (std::size_t i = 0; i < snapshot.robots.size() && !robot; ++i) {
    if (can_show(i)) robot = i;
  }
  if (!robot) return;
  SensorInfo sensor = *camera_of(*robot);
  if (const auto& readings = snapshot.robots[*robot].readings) {
    const auto aim = aimOf(sensor, *fleet_.robots[*robot].info.sensors, readings->measurements);
    if (aim) sensor = aimed(std::move(sensor), *aim);
  }
  constexpr double kShare = 0.28;  // of the picture's width
  const int width = std::max(16, static_cast<int>(picture.cols * kShare));
  CameraInfo camera = sensor.camera;
  camera.height_px = std::max(1U, camera.height_px * static_cast<unsigned>(width) / std::max(1U, camera.width_px));
  camera.width_px = static_cast<unsigned>(width);
  const TPose2D& pose = snapshot.robots[*robot].world_from_robot;
  const TPose3D world_from_robot(pose.x, pose.y, fleet_.robots[*robot].body().heights().z_min_m, pose.phi, 0, 0);
  cv::Mat inset = render(camera, world_from_robot + sensor.beams.front().robot_from_beam, snapshot, nullptr);
  const int border = std::max(1, static_cast<int>(std::lround(3 * look_.scale)));
  const auto [red, green, blue] = fleet_.robots[*robot].color;
  cv::copyMakeBorder(inset, inset, border, border, border, border, cv::BORDER_CONSTANT,
                     cv::Scalar(blue, green, red) * 255);
  const cv::Rect place(picture.cols - inset.cols - 3 * border, 3 * border, inset.cols, inset.rows);
  if ((place & cv::Rect({}, picture.size())) != place) return;
  DrawingSurface surface(inset);
  const double text_px = kTextSize_px * look_.scale;
  surface.text({border + 6 * look_.scale, border + 1.2 * text_px}, fleet_.robots[*robot].info.name, text_px, kInkColor);
  surface.picture().copyTo(picture(place));
}

std::vector<std::uint8_t> Panes::requestedReadings() const {
  if (fleet_.robots.size() <= kMaxWithReadings && layers_.only.empty()) return {};
  std::vector<std::uint8_t> wanted(fleet_.robots.size(), 0);
  const auto selected = static_cast<std::size_t>(std::count(layers_.only.begin(), layers_.only.end(), 1));
  for (std::size_t i = 0; i < wanted.size() && selected <= kMaxWithReadings; ++i) {
    wanted[i] = !layers_.only.empty() && layers_.shows(i) ? 1 : 0;
  }
  for (const auto& pane : panes_) {
    if (pane.follow) wanted[*pane.follow] = 1;
  }
  return wanted;
}

std::optional<std::size_t> Panes::paneAt(const TPoint2D& at) const {
  for (std::size_t i = 0; i < panes_.size(); ++i) {
    if (rectOf(i).contains({static_cast<int>(at.x), static_cast<int>(at.y)})) return i;
  }
  return std::nullopt;
}

Pane* Panes::findPane(const TPoint2D& at, TPoint2D& pixel_in_pane) {
  const auto index = paneAt(at);
  if (!index) return nullptr;
  const cv::Rect rect = rectOf(*index);
  pixel_in_pane = {(at.x - rect.x) / look_.scale, (at.y - rect.y) / look_.scale};
  return &panes_[*index];
}

PaneProjection Panes::projection(std::size_t pane, const RunSnapshot& snapshot) const {
  const cv::Rect rect = rectOf(pane);
  const TPoint2D corner(rect.x, rect.y);
  if (!panes_[pane].is_3d) return {TopView::groundView(snapshot, panes_[pane].top), corner, look_.scale};
  return {airCamera(pane), worldFromAirCamera(panes_[pane], snapshot), corner};
}

void Panes::drag(const TPoint2D& at, const TPoint2D& by_px, Drag how) {
  TPoint2D pixel_in_pane;
  Pane* const pane = findPane(at, pixel_in_pane);
  if (!pane) return;
  if (!pane->is_3d) {
    pane->top.center += TPoint2D(-by_px.x, by_px.y) * (1 / (pane->top.px_per_m * look_.scale));
    return;
  }
  OrbitCamera& air = pane->air;
  if (how == Drag::turn) {
    constexpr double kPerPixel_rad = 0.006;
    air.azimuth_rad -= by_px.x * kPerPixel_rad;
    air.elevation_rad = std::clamp(air.elevation_rad + by_px.y * kPerPixel_rad, 0.02, M_PI / 2 - 0.01);
    return;
  }
  // Size of a pixel on the ground at the target's distance.
  const double per_pixel_m =
      2 * air.distance_m * std::tan(air.field_of_view_rad / 2) / (pane->top.width_px * look_.scale);
  const TPoint2D ahead(-std::cos(air.azimuth_rad), -std::sin(air.azimuth_rad));
  const TPoint2D right(ahead.y, -ahead.x);
  air.target += right * (-by_px.x * per_pixel_m) + ahead * (by_px.y * per_pixel_m / std::sin(air.elevation_rad));
}

void Panes::zoom(const TPoint2D& at, double factor) {
  TPoint2D pixel_in_pane;
  Pane* const pane = findPane(at, pixel_in_pane);
  if (!pane) return;
  if (pane->is_3d) {
    pane->air.distance_m = std::clamp(pane->air.distance_m / factor, 0.3, 1e5);
  } else {
    const TPoint2D middle(pane->top.width_px / 2.0, pane->top.height_px / 2.0);
    pane->top.zoom(factor, pane->follow ? middle : pixel_in_pane);
  }
}

void Panes::click(const TPoint2D& at, const RunSnapshot& snapshot) {
  TPoint2D pixel_in_pane;
  Pane* const pane = findPane(at, pixel_in_pane);
  if (!pane || pane->is_3d) return;
  const auto robot = TopView::robotAt(pixel_in_pane, onlyShown(snapshot, layers_), fleet_, pane->top);
  if (!robot && !pane->follow) return;
  if (!robot)
    pane->top.center =
        TopView::groundView(snapshot, pane->top).toWorld({pane->top.width_px / 2.0, pane->top.height_px / 2.0});
  pane->follow = pane->top.follow = robot;
  // 3D panes follow the robot picked in a 2D pane.
  for (auto& other : panes_) {
    if (other.is_3d && other.follow && robot) other.follow = other.top.follow = robot;
  }
}

void Panes::showAll() {
  for (std::size_t i = 0; i < panes_.size(); ++i) {
    panes_[i].follow.reset();
    fit(panes_[i], i);
  }
}

void Panes::followNext(const RunSnapshot& snapshot) {
  const std::size_t robots = snapshot.robots.size();
  for (std::size_t i = 0; i < panes_.size(); ++i) {
    Pane& pane = panes_[i];
    const bool is_first = !pane.follow;
    const std::size_t begin = is_first ? 0 : *pane.follow + 1;
    for (std::size_t k = 0; k < robots; ++k) {
      const std::size_t next = (begin + k) % robots;
      if (!snapshot.robots[next].isPresent() || !layers_.shows(next)) continue;
      pane.follow = pane.top.follow = next;
      if (is_first) fit(pane, i);
      break;
    }
  }
}

}  // namespace robosim
