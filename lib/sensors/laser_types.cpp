#include "sensors/laser_types.h"

namespace robosim {
namespace {

constexpr double kRadPerDeg = M_PI / 180;

// clang-format off
/// Sources of all figures: doc/fidelity.md.
const LaserType kTypes[] = {
    {.name = "lms200",
     .errors = {.std_at = {{0, 0.005}, {8, 0.005}, {30, 0.010}},
                .tail = 0.03, .tail_factor = 5, .quantum_m = 0.01, .dropout = 0.001, .outlier = 0.0005,
                .divergence_rad = 0.0044, .mixing_m = 2, .mixing_std = 0.1,
                .reach_m = 31.6, .fading = 0.1, .drift_m = -0.01, .drift_s = 3600},
     .sweep_s = 0.00667},
    {.name = "urg04lx",
     .errors = {.std_at = {{0, 0.003}, {1, 0.004}, {4, 0.012}},
                .quantum_m = 0.001, .dropout = 0.002,
                .divergence_rad = 0.6 * kRadPerDeg, .mixing_m = 1, .mixing_std = 0.15,
                .reach_m = 5.6, .fading = 0.2, .drift_m = 0.015, .drift_s = 1800},
     .sweep_s = 0.0667},
    {.name = "utm30lx",
     .errors = {.std_at = {{0, 0.010}, {10, 0.010}, {30, 0.030}},
                .quantum_m = 0.001, .dropout = 0.001,
                .divergence_rad = 0.15 * kRadPerDeg, .mixing_m = 1, .mixing_std = 0.1,
                .reach_m = 60, .fading = 0.2, .drift_m = 0.007, .drift_s = 1200},
     .sweep_s = 0.01875},
};
// clang-format on

}  // namespace

const LaserType* laserTypeNamed(const std::string& name) {
  for (const auto& type : kTypes) {
    if (type.name == name) return &type;
  }
  return nullptr;
}

}  // namespace robosim
