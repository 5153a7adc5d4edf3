#pragma once
#include <limits>
#include <vector>

#include "sensors/laser_errors.h"
#include "sensors/sensor.h"

namespace robosim {

/// Hits of the beams of one scan, by beam.
struct BeamHits {
  std::vector<Ray> rays;           ///< world frame; set only where an error model needs them
  std::vector<double> distance_m;  ///< infinite without a hit
  std::vector<BodyId> body;
  std::vector<double> read_m;  ///< the readings

  void reset(std::size_t beams) {
    rays.resize(beams);
    distance_m.assign(beams, std::numeric_limits<double>::infinity());
    body.assign(beams, kNoBody);
    read_m.resize(beams);
  }
  void set(std::size_t i, double hit_m, BodyId hit_body) {
    distance_m[i] = hit_m;
    body[i] = hit_body;
  }
};

/// Light that returns to a scanner.
struct Return {
  double range_m = std::numeric_limits<double>::infinity();
  double power = 1;  ///< relative to that which is detected half of the time
};

/// Light returned from the footprint of a beam, which is a horizontal sector of the full angle
/// LaserErrors::divergence_rad with uniform brightness. Where the surfaces at the middle and at an edge of the
/// footprint differ, each contributes its share of the power; the border between them is found by bisection. Power
/// falls with the square of the range and with the cosine of the angle of incidence (Lambert), and is proportional to
/// the reflectivity.
///
/// An edge is examined only where the adjacent beam hits another body. Omitted: bodies within the footprint that
/// neither its middle nor an edge hits, and the vertical extent.
class BeamFootprint {
 public:
  BeamFootprint(const Snapshot& now, BodyId owner, const LaserErrors& errors, double range_max_m)
      : now_(now), owner_(owner), errors_(errors), range_max_m_(range_max_m) {}

  /// @param gaussian random error of a mixed pixel's shares, in standard deviations
  Return returnOf(const BeamHits& hits, std::size_t i, double gaussian) const;

 private:
  double power(const Ray& ray, double distance_m, BodyId body) const;
  Return mixed(const BeamHits& hits, std::size_t i, int side, double gaussian) const;

  const Snapshot& now_;
  BodyId owner_;
  const LaserErrors& errors_;
  double range_max_m_;
};

}  // namespace robosim
