#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace robosim {

/// Level of detail of a picture, by the part of its area that each robot has. In a picture with many robots, marks of
/// the usual size would cover the plane: there, robots are dots of their true size, paths are thin and fade with age or
/// are absent, and starts, areas measured by sensors and names are not drawn. A density map takes the place of robots
/// and paths. The owner of this rule for all views, windows, videos and figures.
struct DetailLevel {
  /// More than kManyRobots robots with less than kArea_px2 each. Zooming in on some of them shows them in full.
  bool is_crowded = false;
  bool has_paths = true;       ///< whether there is room for paths
  bool has_robots = true;      ///< whether robots are drawn; otherwise the density map shows them
  double radius_min_px = 3;    ///< of a drawn robot
  double path_share = 1;       ///< width of a path, relative to the usual one
  double path_coverage = 1.0;  ///< share of the picture that paths may cover at full opacity; beyond, they are paler

  static constexpr std::size_t kManyRobots = 60;
  static constexpr double kArea_px2 = 50 * 50, kAreaWithPath_px2 = 12 * 12;
  /// Radius to which robots are enlarged that would otherwise not be seen: many robots by no more than necessary.
  static constexpr double kSeen_px = 1.5, kLeast_px = 1;

  /// @param robots in the picture @param area_px2 of the picture that they are in
  /// @param has_density whether the picture has a density map
  static DetailLevel of(std::size_t robots, double area_px2, bool has_density = false) {
    const double each_px2 = area_px2 / static_cast<double>(std::max<std::size_t>(1, robots));
    DetailLevel level;
    if (robots <= kManyRobots || each_px2 >= kArea_px2) return level;
    constexpr double kCovered = 0.12;  // share of the plane that robots cover at most, unless they are that large
    level.is_crowded = true;
    level.has_robots = !has_density;
    level.has_paths = !has_density && each_px2 >= kAreaWithPath_px2;
    level.radius_min_px = std::clamp(std::sqrt(kCovered * each_px2 / M_PI), kLeast_px, kSeen_px);
    level.path_share = 0.5;
    level.path_coverage = 0.02;
    return level;
  }
};

}  // namespace robosim
