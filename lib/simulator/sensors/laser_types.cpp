#include "sensors/laser_types.h"

#include "base/angle_units.h"

namespace robosim {
namespace {

// clang-format off
/// Sources of all figures: doc/fidelity.md.
const LaserType kTypes[] = {
    {.name = "lms200",
     .errors = {.std_m = 0.005, .std_at = {}, .tail = 0.03, .tail_factor = 6, .quantum_m = 0.01, .outlier = 0.0007,
                .divergence_rad = 0.25 * kRadPerDeg, .reach_m = 31.6, .fading = 0.1},
     .sweep_s = 0.00667},
    {.name = "urg04lx",
     .errors = {.std_at = {{1, 0.005}, {4, 0.020}}, .quantum_m = 0.001,
                .divergence_rad = 0.57 * kRadPerDeg, .reach_m = 5.6, .fading = 0.1},
     .sweep_s = 0.0666},
    {.name = "utm30lx",
     .errors = {.std_at = {{10, 0.010}, {30, 0.030}}, .quantum_m = 0.001,
                .divergence_rad = 0.25 * kRadPerDeg, .reach_m = 60, .fading = 0.1},
     .sweep_s = 0.01876},
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
