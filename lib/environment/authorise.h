#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "environment/robot_range.h"
#include "geometry/path.h"
#include "geometry/scene.h"

namespace robosim {

/// A robot that asks to move: a disc that stands upright.
struct Mover {
  double radius_m = 0;
  HeightSpan heights;
};

/// Decides how far each robot may go (the rule is in environment.h): begin(), then clip() all, then judge() all, then
/// conclude(). Keeps its working memory from step to step. `scene` is frozen where the robots stand now, and `paths`
/// are all robots' in each call.
class Authority {
 public:
  Authority(std::vector<Mover> movers, const Bounds2D& surface);

  void begin(std::span<const Path> paths);
  /// Rule (a): cuts the paths of some robots at their first contact.
  void clip(const Scene& scene, const Workers& workers, RobotRange range, std::span<Path> paths);
  /// The same for one robot that somebody else has clipped.
  void putClipped(std::size_t robot, double end_fraction, std::span<Path> paths);
  /// Rule (b): finds out which of some robots stay where they started.
  void judge(const Scene& scene, const Workers& workers, RobotRange range, std::span<const Path> paths);
  /// The outcome of judge(), to be read, or to be put by somebody else who has judged: 1 for a robot that stays.
  std::span<std::uint8_t> stays() { return stays_; }
  /// Cuts the paths of those that stay.
  /// @param stalled set to 1 for each robot whose path was cut short
  void conclude(const Workers& workers, std::span<Path> paths, std::span<std::uint8_t> stalled);

 private:
  void clip(const Scene& scene, std::size_t robot, std::span<Path> paths);
  /// How far from a robot others may be that it could meet in this step [m].
  double reachOfMeeting(std::size_t robot, const Path& path) const;
  bool meetsAnother(const Scene& scene, std::size_t robot, std::span<const Path> paths) const;

  std::vector<Mover> movers_;
  Bounds2D surface_;
  double radius_max_m_ = 0;
  double length_max_m_ = 0;                ///< of this step's paths
  std::vector<std::uint8_t> has_company_;  ///< another robot is near enough to meet
  std::vector<std::uint8_t> stays_;
};

}  // namespace robosim
