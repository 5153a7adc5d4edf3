#include "rendering/run_paths.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <mrpt/math/wrap2pi.h>

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr double kKnown_m = 1;  // longest step across missing ones that is joined
constexpr std::size_t kMaxPointsOfAll = 2'000'000, kMinPoints = 16;
constexpr double kSame_s = 1e-9;

bool isBefore(const PathPoint& point, double time_s) { return point.time_s < time_s; }

}  // namespace

bool isJump(const TPoint2D& from, const TPoint2D& to, double duration_s) {
  constexpr double kLongest_s = 10, kFastest_mps = 100;
  const double way_m = (to - from).norm();
  return way_m > kKnown_m && (duration_s > kLongest_s || (duration_s > 0 && way_m > kFastest_mps * duration_s));
}

/// Narrows the sleeve to the directions that pass `to` within the tolerance. @return whether `to` may end the segment
bool RunPaths::Path::extend(const TPoint2D& to) {
  const TPoint2D way = to - points.back().at;
  const double far_m = way.norm();
  const double limit_m = tolerance_m * M_SQRT1_2;  // across the segment; at its end also along it
  if (far_m < farthest_m - limit_m) return false;  // the robot turned back
  farthest_m = std::max(farthest_m, far_m);
  if (far_m <= limit_m) return true;
  const double direction_rad = std::atan2(way.y, way.x), half_rad = std::asin(limit_m / far_m);
  if (!std::exchange(is_bounded, true)) {
    middle_rad = direction_rad;
    low_rad = -half_rad;
    high_rad = half_rad;
    return true;
  }
  const double off_rad = mrpt::math::wrapToPi(direction_rad - middle_rad);
  if (off_rad < low_rad || off_rad > high_rad) return false;
  low_rad = std::max(low_rad, off_rad - half_rad);
  high_rad = std::min(high_rad, off_rad + half_rad);
  return true;
}

void RunPaths::Path::addVertex(const PathPoint& point) {
  points.push_back(point);
  has_open_segment = is_bounded = false;
  farthest_m = 0;
}

void RunPaths::Path::add(const PathPoint& point) {
  if (points.empty()) return addVertex(point);
  if (point.is_after_gap) {
    if (has_open_segment) addVertex(latest);
    return addVertex(point);
  }
  if (!extend(point.at)) {
    addVertex(latest);
    extend(point.at);
  }
  latest = point;
  has_open_segment = true;
}

void RunPaths::Path::thin(std::size_t max_points) {
  std::vector<PathPoint> old = std::move(points);
  if (has_open_segment) old.push_back(latest);
  const double before_m = tolerance_m;
  // Gaps and sharp corners remain at any tolerance; without end, old ones are dropped.
  if (before_m > 1e6) old.erase(old.begin(), old.begin() + static_cast<std::ptrdiff_t>(old.size() / 2));
  *this = {};
  tolerance_m = 2 * before_m;
  points.reserve(max_points / 2);
  for (const auto& point : old) add(point);
}

void RunPaths::add(const RunSnapshot& snapshot) {
  std::vector<mrpt::math::TPose2D> poses;
  poses.reserve(snapshot.robots.size());
  for (const auto& robot : snapshot.robots) poses.push_back(robot.shownPose());
  add(snapshot.step, snapshot.time_s, poses);
}

void RunPaths::add(std::uint64_t step, double time_s, const std::vector<mrpt::math::TPose2D>& world_from_robot) {
  if (time_s < last_time_s_) clear();
  const bool has_skipped = step > last_step_ + 1;
  last_step_ = step;
  const double duration_s = time_s - std::exchange(last_time_s_, time_s);
  of_robot_.resize(world_from_robot.size());
  const std::size_t max_points =
      std::min(max_points_, std::max(kMinPoints, kMaxPointsOfAll / std::max<std::size_t>(1, of_robot_.size())));
  for (std::size_t i = 0; i < of_robot_.size(); ++i) {
    Path& path = of_robot_[i];
    if (std::isnan(world_from_robot[i].x)) {
      path.is_interrupted = true;
      continue;
    }
    const TPoint2D at(world_from_robot[i].x, world_from_robot[i].y);
    const TPoint2D before = path.has_open_segment ? path.latest.at : path.points.empty() ? at : path.points.back().at;
    const bool has_jumped = (has_skipped && (at - before).norm() > kKnown_m) || isJump(before, at, duration_s);
    const bool has_gap = std::exchange(path.is_interrupted, false) || has_jumped;
    path.add({at, time_s, has_gap && !path.points.empty()});
    while (path.points.size() > max_points) path.thin(max_points);
  }
}

PathPart RunPaths::between(std::size_t robot, double from_s, double to_s) const {
  if (robot >= of_robot_.size()) return {};
  const auto& points = of_robot_[robot].points;
  const auto begin = std::lower_bound(points.begin(), points.end(), from_s - kSame_s, isBefore);
  const auto end = std::lower_bound(begin, points.end(), to_s + kSame_s, isBefore);
  PathPart part{std::nullopt, {begin, end}};
  if (begin == points.end() || begin->time_s > from_s + kSame_s) part.begin = positionAt(robot, from_s);
  return part;
}

std::optional<TPoint2D> RunPaths::positionAt(std::size_t robot, double time_s) const {
  if (robot >= of_robot_.size()) return std::nullopt;
  const Path& path = of_robot_[robot];
  const auto next = std::lower_bound(path.points.begin(), path.points.end(), time_s, isBefore);
  if (next == path.points.begin()) return std::nullopt;
  const PathPoint& before = *(next - 1);
  const PathPoint& after = next != path.points.end() ? *next : path.has_open_segment ? path.latest : before;
  if (after.is_after_gap) return std::nullopt;
  if (after.time_s <= before.time_s) return before.at;
  return before.at +
         (after.at - before.at) * std::clamp((time_s - before.time_s) / (after.time_s - before.time_s), 0.0, 1.0);
}

}  // namespace robosim
