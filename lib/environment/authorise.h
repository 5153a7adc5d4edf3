#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "geometry/path.h"
#include "geometry/scene.h"

namespace robosim {

/// A robot that asks to move: a disc that stands upright.
struct Mover {
  double radius_m = 0;
  HeightSpan heights;
};

/// Decides how far each robot may go (the rule is in environment.h). Keeps its working memory from step to step.
class Authority {
 public:
  Authority(std::vector<Mover> movers, const Bounds2D& surface);

  /// Shortens the robots' paths in place until no two bodies can overlap.
  /// @param scene frozen where the robots stand now
  /// @param near what stands around each robot
  /// @param stalled set to 1 for each robot whose path was cut short
  void authorise(const Scene& scene, std::span<const NeighbourList> near, const Workers& workers, std::span<Path> paths,
                 std::span<std::uint8_t> stalled);

 private:
  void clip(const Scene& scene, const NeighbourList& near, std::size_t robot, std::span<Path> paths);
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
