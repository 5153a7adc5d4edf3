#pragma once
#include <limits>
#include <vector>

#include "geometry/shapes/solid.h"
#include "sensors/laser_errors.h"
#include "sensors/planar_beams.h"
#include "sensors/sensor.h"

namespace robosim {

/// Hits of the beams of one scan, by beam.
struct BeamHits {
  std::vector<double> distance_m;  ///< infinite without a hit
  std::vector<BodyId> body;
  bool is_moved = false;   ///< otherwise all beams were cast from the pose below
  std::vector<Ray> moved;  ///< world frame; memory is kept, and may be longer than the scan
  const PlanarBeams* beams = nullptr;
  PlanarTransform frame, panned;  ///< of the robot, and turned by the pan angle

  void reset(const PlanarBeams& cast, const PlanarTransform& world_from_robot, double pan_rad) {
    distance_m.assign(cast.size(), std::numeric_limits<double>::infinity());
    body.assign(cast.size(), kNoBody);
    is_moved = false;
    beams = &cast;
    frame = world_from_robot;
    panned = PlanarTransform(frame, pan_rad);
  }
  void set(std::size_t i, double hit_m, BodyId hit_body) {
    if (hit_body == kNoBody) return;
    distance_m[i] = hit_m;
    body[i] = hit_body;
  }
  /// The beam in the world.
  Ray ray(std::size_t i) const {
    if (is_moved) return moved[i];
    return {frame.pointToWorld((*beams)[i].origin), panned.turnToWorld((*beams)[i].direction)};
  }
};

/// Light that returns to a scanner.
struct Return {
  double range_m = std::numeric_limits<double>::infinity();
  double power = 1;  ///< relative to that which is detected half of the time
};

/// Light returned from the footprint of a beam: a horizontal sector of the full angle LaserErrors::divergence_rad with
/// uniform brightness. Where the adjacent beam hits another body, and the border between the two lies within the
/// footprint, each body contributes its share of the power; the border is found by bisection. Power falls with the
/// square of the range and with the cosine of the angle of incidence (Lambert), and is proportional to the
/// reflectivity.
///
/// Omitted: further bodies within the footprint, its other side, and its vertical extent.
class BeamFootprint {
 public:
  BeamFootprint(const Snapshot& now, const LaserErrors& errors) : now_(now), errors_(errors) {}

  /// The side on which the adjacent beam hits the more distant surface from that of beam i: 1 for the next beam, -1 for
  /// the one before. 0 if both hit the same body, or one as near, or if the beams do not diverge: then the footprint
  /// has one surface.
  int mixingSide(const BeamHits& hits, std::size_t i) const {
    if (!(errors_.divergence_rad > 0)) return 0;
    const BodyId own = hits.body[i];
    const bool is_alone = (i == 0 || hits.body[i - 1] == own) && (i + 1 == hits.body.size() || hits.body[i + 1] == own);
    return is_alone ? 0 : sideOfOther(hits, i);
  }
  /// Light from one surface.
  Return computeReturn(const BeamHits& hits, std::size_t i);
  /// Light from two surfaces.
  /// @param side mixingSide(), not 0
  /// @param distortion random error of a mixed pixel's shares, in standard deviations
  Return mixed(const BeamHits& hits, std::size_t i, int side, double distortion);

 private:
  int sideOfOther(const BeamHits& hits, std::size_t i) const;
  double power(const Ray& ray, double distance_m, BodyId body);

  const Snapshot& now_;
  const LaserErrors& errors_;
  // The body that power() was computed of last: adjacent beams often hit the same.
  BodyId lit_body_ = kNoBody;
  Outline lit_outline_;
};

}  // namespace robosim
