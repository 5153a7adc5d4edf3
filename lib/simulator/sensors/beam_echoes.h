#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/shapes/planar_transform.h"
#include "geometry/shapes/ray.h"
#include "hardware/measurement.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// Origins and directions of thin beams, robot frame, before panning. By four, so that loops over beams use vectors.
class BeamFields {
 public:
  struct Four {
    double x[4] = {}, y[4] = {}, z[4] = {}, dx[4] = {}, dy[4] = {}, dz[4] = {};
  };

  void add(const Ray& beam);
  std::size_t size() const { return size_; }
  const Four* fours() const { return fours_.data(); }

 private:
  std::vector<Four> fours_;
  std::size_t size_ = 0;
};

/// Ranges of a sensor, and the rotation of its pan. A distance of range_max_m or more gives no echo.
struct EchoRule {
  double cos = 1, sin = 0;
  float range_min_m, range_max_m, no_echo_m;

  explicit EchoRule(const SensorInfo& info, const PlanarTransform& pan = {});
  bool pans() const { return sin != 0 || cos != 1; }
};

/// Computes the echo of each beam from the distance of its hit.
/// @param hit_m by beam; may be longer
void setEchoes(const BeamFields& beams, const EchoRule& rule, std::span<const double> hit_m, Echoes& echoes);
/// The same for beams in another order than the echoes'.
/// @param order index of each beam's echo
void setEchoes(const BeamFields& beams, const EchoRule& rule, std::span<const double> hit_m,
               std::span<const std::uint32_t> order, Echoes& echoes);

}  // namespace robosim
