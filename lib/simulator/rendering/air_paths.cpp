#include "rendering/air_paths.h"

#include <algorithm>
#include <optional>

#include "rendering/ground_painter.h"
#include "rendering/path_fading.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;

constexpr double kPathHeight_m = 0.02;  // above the ground

/// The visible parts of one path: pieces of a few pixels, each of them where it is visible.
class VisiblePath {
 public:
  using Line = std::vector<TPoint2D>;  ///< pixels

  VisiblePath(const AirPicture& air, const AirView& view) : air_(air), view_(view) {}

  void lineTo(const TPoint2D& at) {
    const TPoint3D next = view_.seen({at.x, at.y, kPathHeight_m});
    constexpr double kStride_px = 2;
    if (last_ && last_->x > AirView::kNearest_m && next.x > AirView::kNearest_m &&
        (view_.pixel(next) - view_.pixel(*last_)).norm() < kStride_px) {
      return;
    }
    if (last_) addLine(*last_, next);
    last_ = next;
  }

  /// A part of a path, which ends at `end` if that is known.
  void add(const PathPart& part, const std::optional<TPoint2D>& end) {
    if (part.begin) lineTo(*part.begin);
    for (const auto& point : part.points) {
      if (point.is_after_gap) last_.reset();
      lineTo(point.at);
    }
    if (end && (part.begin || !part.points.empty())) lineTo(*end);
  }

  const std::vector<Line>& lines() const { return lines_; }
  /// [px]
  double length() const {
    double length_px = 0;
    for (const auto& line : lines_) {
      for (std::size_t i = 1; i < line.size(); ++i) length_px += (line[i] - line[i - 1]).norm();
    }
    return length_px;
  }

 private:
  /// Ends in the camera's axes.
  void addLine(TPoint3D from, TPoint3D to) {
    if (from.x < AirView::kNearest_m && to.x < AirView::kNearest_m) return;
    if (from.x < AirView::kNearest_m || to.x < AirView::kNearest_m) {
      const TPoint3D cut = from + (to - from) * ((AirView::kNearest_m - from.x) / (to.x - from.x));
      (from.x < AirView::kNearest_m ? from : to) = cut;
    }
    const TPoint2D a = view_.pixel(from), b = view_.pixel(to);
    const double right = air_.picture.cols, bottom = air_.picture.rows;
    if (std::max(a.x, b.x) < 0 || std::max(a.y, b.y) < 0 || std::min(a.x, b.x) > right || std::min(a.y, b.y) > bottom) {
      return;
    }
    constexpr double kPiece_px = 6;
    const int pieces = std::clamp(static_cast<int>((b - a).norm() / kPiece_px), 1, 2000);
    const TPoint2D piece = (b - a) * (1.0 / pieces);
    int first_visible = -1;
    for (int i = 0; i <= pieces; ++i) {
      const double share = (i + 0.5) / pieces;
      const TPoint2D center = a + piece * (i + 0.5);
      // Equal steps on the picture are not equal steps in space: 1 / depth is linear there.
      const double ahead_m = 1 / ((1 - share) / from.x + share / to.x);
      const bool is_visible = i < pieces && view_.isOnPicture(center) && view_.isVisible(center, ahead_m, 0.05);
      if (is_visible && first_visible < 0) first_visible = i;
      if (is_visible || first_visible < 0) continue;
      const TPoint2D begin = a + piece * first_visible;
      if (lines_.empty() || lines_.back().back() != begin) lines_.push_back({begin});
      lines_.back().push_back(i == pieces ? b : a + piece * i);
      first_visible = -1;
    }
  }

  const AirPicture& air_;
  const AirView& view_;
  std::optional<TPoint3D> last_;
  std::vector<Line> lines_;
};

}  // namespace

void drawAirPaths(DrawingSurface& surface, const AirPicture& air, const AirView& view, const RunSnapshot& snapshot,
                  const std::vector<Color>& colors, const RunPaths& paths, const ViewLayers& layers,
                  const DetailLevel& level) {
  const double width_px = 2 * air.scale * level.path_share;
  const double recent_from_s = std::max(layers.paths_from_s, snapshot.time_s - kRecentPath_s);
  /// The visible parts of all paths within a time range.
  const auto visible = [&](double from_s, double to_s) {
    std::vector<VisiblePath> all(snapshot.robots.size(), {air, view});
    for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
      if (!layers.shows(i)) continue;
      std::optional<TPoint2D> end;
      if (to_s < snapshot.time_s) {
        end = paths.positionAt(i, to_s);
      } else if (snapshot.robots[i].isPresent()) {
        const auto& pose = snapshot.robots[i].world_from_robot;
        end.emplace(pose.x, pose.y);
      }
      all[i].add(paths.between(i, from_s, to_s), end);
    }
    return all;
  };
  const auto draw = [&](const std::vector<VisiblePath>& all, const Color& faded, float fading) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (const auto& line : all[i].lines()) surface.polyline(line, width_px, mix(colors[i], faded, fading));
    }
  };
  if (level.is_crowded) {
    constexpr Color kGroundColor{0.74f, 0.735f, 0.71f};
    constexpr float kNewest = 0.35f;
    for (const auto& part : trailParts(recent_from_s, snapshot.time_s, kNewest)) {
      draw(visible(part.from_s, part.to_s), kGroundColor, part.paleness);
    }
    return;
  }
  const auto old = visible(layers.paths_from_s, recent_from_s);
  double length_px = 0;
  for (const auto& path : old) length_px += path.length();
  draw(old, kFloorColor, pathFading(length_px * width_px / (1.0 * air.picture.cols * air.picture.rows)));
  draw(visible(recent_from_s, snapshot.time_s), kFloorColor, 0);
}

}  // namespace robosim
