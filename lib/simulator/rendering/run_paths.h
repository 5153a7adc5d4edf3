#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include "robots/run_snapshot.h"

namespace robosim {

/// A vertex of a robot's path.
struct PathPoint {
  mrpt::math::TPoint2D at;  ///< of the robot's centre, world frame [m]
  double time_s = 0;
  bool is_after_gap = false;  ///< the path from the previous vertex is unknown
};

/// A part of a robot's path, as vertices joined by straight lines.
struct PathPart {
  std::optional<mrpt::math::TPoint2D> begin;  ///< position before the first vertex, if the part begins between vertices
  std::span<const PathPoint> points;          ///< the oldest first; valid until the paths change
};

/// Whether the way between two positions is unknown, because a robot needed more than 10 s, or was faster than any
/// robot can be (100 m/s). Up to 1 m are always a way.
/// @param duration_s 0 if unknown
bool isJump(const mrpt::math::TPoint2D& from, const mrpt::math::TPoint2D& to, double duration_s);

/// Paths of all robots of a run, from its steps, independent of what is drawn. Each path is simplified while it grows
/// by sleeve fitting (Zhao & Saalfeld 1997): a vertex is omitted if the straight line that replaces it passes within
/// the tolerance of every omitted point, and the robot did not turn back. When a path exceeds the maximum number of
/// vertices, its tolerance doubles and it is simplified again, so that memory is bounded for runs of any length and the
/// path still reaches from the start to the end.
///
/// Steps may be missing (a viewer of a fast run); vertices are joined across them up to 1 m, and a longer step starts
/// after a gap, because a wall may lie in between. So does a robot that was absent, and a jump.
class RunPaths {
 public:
  static constexpr double kTolerance_m = 0.01;  ///< initial
  static constexpr std::size_t kMaxPoints = 8000;

  /// @param max_points per robot; reduced to 2,000,000 for all robots, but not below 16 each
  explicit RunPaths(std::size_t max_points = kMaxPoints) : max_points_(max_points) {}

  void add(const RunSnapshot& snapshot);
  /// The same for the poses of a step, kNotShown for absent robots. A time before the last one starts all paths again.
  void add(std::uint64_t step, double time_s, const std::vector<mrpt::math::TPose2D>& world_from_robot);
  void clear() { of_robot_.clear(); }

  std::size_t robots() const { return of_robot_.size(); }
  /// A robot's path within [from_s, to_s]. It continues from the last vertex straight to the robot's position at
  /// `to_s`.
  PathPart between(std::size_t robot, double from_s, double to_s) const;
  /// Position on the path at a time after its start, by linear interpolation between vertices: within the deviation
  /// below across the path, and the farther along it, the less even the robot's speed. nullopt before the start, and in
  /// a gap.
  std::optional<mrpt::math::TPoint2D> positionAt(std::size_t robot, double time_s) const;
  /// Upper bound of the distance of any omitted point of a robot's path from the simplified path [m]. The deviations of
  /// repeated simplifications add up: 1 + 1/2 + 1/4 + … of the last tolerance.
  double deviationMax(std::size_t robot) const { return 2 * of_robot_[robot].tolerance_m; }

 private:
  /// One path, with the sleeve of the segment that begins at its last vertex.
  struct Path {
    std::vector<PathPoint> points;
    PathPoint latest;  ///< end of the open segment
    bool has_open_segment = false;
    bool is_interrupted = false;  ///< the robot was absent in the last step
    double tolerance_m = kTolerance_m;
    /// @name Sleeve of the open segment
    ///@{
    bool is_bounded = false;  ///< directions are restricted
    double middle_rad = 0;    ///< direction to which the limits are relative
    double low_rad = 0, high_rad = 0;
    double farthest_m = 0;  ///< from the last vertex
    ///@}

    void add(const PathPoint& point);
    void addVertex(const PathPoint& point);
    bool extend(const mrpt::math::TPoint2D& to);
    void thin(std::size_t max_points);
  };

  std::size_t max_points_;
  std::uint64_t last_step_ = 0;
  double last_time_s_ = 0;
  std::vector<Path> of_robot_;
};

}  // namespace robosim
