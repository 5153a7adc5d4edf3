#include "tests/slam_errors/surface_light.h"

#include <algorithm>
#include <cmath>

#include "geometry/scene.h"
#include "world/world.h"

namespace robosim {
namespace {

constexpr double kSameSurface_m = 0.3;
/// Share of the echoes that are lost whatever the surface is: of the recording SENA below 6 m.
constexpr double kLost = 0.005;

/// A beam that meets a solid.
struct Meeting {
  double log_power = 0;  ///< of the echo of a white surface
  bool has_echo = false;
};

double computeLogLikelihood(const std::vector<Meeting>& meetings, double log_reflectivity, double fading) {
  double sum = 0;
  for (const auto& [log_power, has_echo] : meetings) {
    const double detected = (1 - kLost) / (1 + std::exp(-(log_power + log_reflectivity) / fading));
    sum += std::log(std::max(has_echo ? detected : 1 - detected, 1e-30));
  }
  return sum;
}

double mostLikely(const std::vector<Meeting>& meetings, double fading) {
  constexpr double kLeast = 1e-4;
  constexpr int kSteps = 200;  // of the logarithm, 5 % each
  double best = 1, best_likelihood = computeLogLikelihood(meetings, 0, fading);
  for (int i = 1; i <= kSteps; ++i) {
    const double log_reflectivity = std::log(kLeast) * i / kSteps;
    const double likelihood = computeLogLikelihood(meetings, log_reflectivity, fading);
    if (likelihood <= best_likelihood) continue;
    best_likelihood = likelihood;
    best = std::exp(log_reflectivity);
  }
  return best;
}

}  // namespace

std::vector<float> computeReflectivities(const std::vector<Solid>& solids, const ScanSeries& recorded,
                                         const std::vector<mrpt::math::TPose2D>& path, const LaserErrors& errors) {
  constexpr double kArea_m = 60;
  const Scene scene(solids, 0, {-kArea_m, kArea_m, -kArea_m, kArea_m});
  std::vector<std::vector<Meeting>> meetings(solids.size());
  for (std::size_t k = 0; k < path.size(); ++k) {
    const mrpt::math::TPose2D scanner = path[k] + recorded.robot_from_scanner;
    const std::vector<double>& ranges_m = recorded.scans[k].ranges_m;
    for (std::size_t i = 0; i < ranges_m.size(); ++i) {
      const double bearing_rad = scanner.phi + recorded.first_rad + recorded.step_rad * static_cast<double>(i);
      const Ray beam{{scanner.x, scanner.y, 1}, {std::cos(bearing_rad), std::sin(bearing_rad), 0}};
      const Hit hit = scene.castRay(beam, recorded.range_max_m);
      const bool has_echo = !std::isnan(ranges_m[i]);
      if (!hit || (has_echo && std::abs(ranges_m[i] - hit.distance_m) > kSameSurface_m)) continue;
      const auto body = static_cast<std::size_t>(hit.body);
      const auto normal = normalAt(solids[body].outline, {hit.point.x, hit.point.y});
      const double cosine = std::abs(beam.direction.x * normal.x + beam.direction.y * normal.y);
      const double reach = errors.reach_m / hit.distance_m;
      meetings[body].push_back({std::log(std::max(cosine, 1e-9) * reach * reach), has_echo});
    }
  }
  std::vector<float> reflectivities;
  for (const auto& of_solid : meetings) {
    reflectivities.push_back(
        static_cast<float>(of_solid.empty() ? kReflectivity : mostLikely(of_solid, errors.fading)));
  }
  return reflectivities;
}

}  // namespace robosim
